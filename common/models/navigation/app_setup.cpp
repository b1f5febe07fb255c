#include "inslab/models/navigation/app_setup.hpp"

#include "inslab/models/navigation/matching_parameters.hpp"
#include "inslab/models/navigation/parameters_file.hpp"

namespace inslab::navigation {

AppSetup setup_for(const scenario::LoadedScenario& scenario, const scenario::ReferenceNav& app) {
  const scenario::LoadedImu& imu = scenario.sensor<catalog::Imu>(app.imu);
  const scenario::LoadedGnss& gnss = scenario.sensor<catalog::Gnss>(app.gnss);
  if (!app.parameters.empty()) {
    return {read_parameters((scenario.file.parent_path() / app.parameters).string()), scenario.gravity(), {}};
  }
  AppSetup setup{
      matching_parameters(imu.errors, imu.nominal_installation, gnss.nominal_installation), scenario.gravity(), {}};
  for (const catalog::AnyProfile& profile :
       {catalog::AnyProfile(imu.errors), catalog::AnyProfile(imu.vibration), catalog::AnyProfile(gnss.errors)}) {
    for (const std::string& name : left_out_of_matching(profile)) setup.left_out.push_back(name);
  }
  return setup;
}

}  // namespace inslab::navigation
