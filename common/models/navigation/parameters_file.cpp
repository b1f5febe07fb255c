#include "inslab/models/navigation/parameters_file.hpp"

#include "inslab/scenario/read_document.hpp"

namespace inslab::navigation {

NavigationParameters read_parameters(const std::string& file) {
  auto parameters = scenario::read_document<NavigationParameters>(file, scenario::DocumentKind::Navigation);
  if (auto broken = violation(parameters)) throw json::Error(file, *broken);
  return parameters;
}

}  // namespace inslab::navigation
