#include "services/reference_nav/parameters_file.hpp"

#include "config/json_reader.hpp"

namespace inslab::reference_nav {

NavigationParameters read_parameters(const std::string& file) {
  auto parameters = config::read_file<NavigationParameters>(file);
  if (auto broken = violation(parameters)) throw config::Error(file, *broken);
  return parameters;
}

}  // namespace inslab::reference_nav
