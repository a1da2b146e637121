#pragma once

/// In front of a function: compiled for wide vectors too, and picked by what the processor can do
/// when the program is loaded. Sanitizers do not go together with such a choice.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define FLEXURA_BY_PROCESSOR __attribute__((target_clones("default", "arch=haswell")))
#else
#define FLEXURA_BY_PROCESSOR
#endif
