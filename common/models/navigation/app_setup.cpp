#include "inslab/models/navigation/app_setup.hpp"

#include "inslab/models/navigation/matching_barometer.hpp"
#include "inslab/models/navigation/matching_magnetometer.hpp"
#include "inslab/models/navigation/matching_parameters.hpp"
#include "inslab/models/navigation/parameters_file.hpp"

namespace inslab::navigation {

AppSetup setup_for(const scenario::LoadedScenario& scenario, const scenario::ReferenceNav& app) {
  const scenario::LoadedImu& imu = scenario.sensor<catalog::Imu>(app.imu);
  const scenario::LoadedGnss& gnss = scenario.sensor<catalog::Gnss>(app.gnss);
  if (!app.parameters.empty()) {
    return {
        read_parameters((scenario.file.parent_path() / app.parameters).string()), scenario.gravity_model(), app, {}};
  }
  AppSetup setup{matching_parameters(imu.errors, imu.nominal_installation, gnss.nominal_installation),
                 scenario.gravity_model(),
                 app,
                 {}};
  const auto note_left_out = [&setup](const catalog::AnyProfile& profile) {
    for (const std::string& name : left_out_of_matching(profile)) setup.left_out.push_back(name);
  };
  note_left_out(imu.errors);
  note_left_out(imu.vibration);
  note_left_out(gnss.errors);
  for_each(scenario::AidKinds{}, [&](auto tag) {
    using Kind = typename decltype(tag)::type;
    const auto number = scenario::sensor_of_the_app<Kind>(app);
    if (!number) return;
    const auto& aid = scenario.sensor<Kind>(*number);
    match(aid.errors, aid.nominal_installation, imu.nominal_installation, setup.parameters);
    note_left_out(aid.errors);
  });
  return setup;
}

}  // namespace inslab::navigation
