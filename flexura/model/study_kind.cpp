#include "flexura/model/study_kind.hpp"

namespace flexura {
namespace {

struct Namer {
  const char* operator()(const LinearStudy&) const { return "linear"; }
  const char* operator()(const PathStudy&) const { return "path"; }
  const char* operator()(const BucklingStudy&) const { return "buckling"; }
  const char* operator()(const InverseStudy&) const { return "inverse"; }
  const char* operator()(const ModesStudy&) const { return "modes"; }
  const char* operator()(const TransientStudy&) const { return "transient"; }
  const char* operator()(const ResponseStudy&) const { return "response"; }
  const char* operator()(const LinkageStudy&) const { return "linkage"; }
};

}  // namespace

std::string study_kind(const Study& study) { return std::visit(Namer{}, study.kind); }

}  // namespace flexura
