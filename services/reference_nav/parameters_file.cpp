#include "services/reference_nav/parameters_file.hpp"

#include "scenario/read_document.hpp"

namespace inslab::reference_nav {

NavigationParameters read_parameters(const std::string& file) {
  auto parameters = scenario::read_document<NavigationParameters>(file, scenario::DocumentKind::Navigation);
  if (auto broken = violation(parameters)) throw config::Error(file, *broken);
  return parameters;
}

}  // namespace inslab::reference_nav
