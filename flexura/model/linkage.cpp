#include "flexura/model/linkage.hpp"

#include <algorithm>

namespace flexura {

bool LinkageStudy::uses(Method method) const {
  return std::find(methods.begin(), methods.end(), method) != methods.end();
}

int LinkageStudy::elements_of(std::size_t flexure) const {
  for (const ElementCount& count : flexure_elements)
    if (count.flexure == flexure) return count.elements;
  return elements;
}

}  // namespace flexura
