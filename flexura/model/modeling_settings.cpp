#include "flexura/model/modeling_settings.hpp"

namespace flexura {
namespace {

struct Name {
  const char* operator()(const LinearSettings&) const { return "linear"; }
  const char* operator()(const ScmbmSettings&) const { return "scmbm"; }
  const char* operator()(const PrbmSettings&) const { return "prbm"; }
  const char* operator()(const ExactSettings&) const { return "exact"; }
  const char* operator()(const BeamSettings&) const { return "beam"; }
  const char* operator()(const BcmSettings&) const { return "bcm"; }
  const char* operator()(const ContinuumSettings&) const { return "continuum"; }
};

}  // namespace

std::string modeling_name(const ModelingSettings& settings) {
  return std::visit(Name{}, settings.kind);
}

}  // namespace flexura
