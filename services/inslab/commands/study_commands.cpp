#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {

void add_commands(CLI::App& app, std::function<int()>& action) {
  add_simulate(app, action);
  add_plot(app, action);
  add_navigate(app, action);
  add_montecarlo(app, action);
  add_align(app, action);
  add_allan(app, action);
  add_graft(app, action);
  add_profile(app, action);
  add_predict(app, action);
  add_verify(app, action);
  add_soak(app, action);
  add_reference(app, action);
}

}  // namespace inslab::commands
