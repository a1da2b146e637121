#pragma once

#include "flexura/energy/continuum.hpp"
#include "flexura/model/model.hpp"
#include "flexura/model/modeling_settings.hpp"

namespace flexura {

/// What `use` makes of the energy density that the settings ask for.
template <class Use>
decltype(auto) with_density(const Material& material, const ContinuumSettings& settings,
                            const Use& use) {
  const LameConstants lame = lame_constants(material.youngs_modulus, material.poissons_ratio);
  if (settings.law == ContinuumSettings::Law::neo_hookean)
    return use(NeoHookean(lame, settings.plane));
  return use(StVenantKirchhoff(lame, settings.plane));
}

}  // namespace flexura
