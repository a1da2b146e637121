// Reads a model, runs it and prints where the first named point of every path ends.
#include <cstdio>

#include "flexura/io/model_reader.hpp"
#include "flexura/studies/run_studies.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: consumer MODEL\n", stderr);
    return 2;
  }
  const flexura::ModelReading reading = flexura::read_model(argv[1]);
  for (const flexura::Diagnostic& found : reading.diagnostics)
    std::fprintf(stderr, "%d: %s\n", found.position.line, found.message.c_str());
  if (!reading.model) return 2;

  const flexura::Result result = flexura::run_studies(*reading.model, {});
  for (const flexura::StudyResult& study : result.studies) {
    const auto* path = std::get_if<flexura::PathResult>(&study.content);
    if (!path) continue;
    for (const flexura::ModelingPath& modeling : path->modelings) {
      const flexura::Vec2 place = modeling.states.back().points.front();
      std::printf("%s %s %.6f %.6f\n", study.name.c_str(), modeling.label.c_str(), place.x,
                  place.y);
    }
  }
  return 0;
}
