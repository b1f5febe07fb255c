#pragma once

#include <optional>
#include <string>
#include <vector>

#include "inslab/referee/predict/response.hpp"

namespace CLI {
class App;
}

namespace inslab::commands {

/// What `inslab predict` is asked of single sources and of the model itself.
struct ResponseRequest {
  std::vector<std::string> sources;
  std::string model_file;
  std::optional<double> latitude_deg;
  predict::ResponseOptions options;

  /// Rather than the covariance of a scenario.
  bool is_asked_for(const std::string& scenario) const {
    return scenario.empty() || !sources.empty() || !model_file.empty();
  }
};

void add_response_options(CLI::App& command, ResponseRequest& request);

/// Along a scenario, or at rest when `scenario` is empty. The exit code.
int run_response(const std::string& scenario, const std::string& directory, ResponseRequest& request);

}  // namespace inslab::commands
