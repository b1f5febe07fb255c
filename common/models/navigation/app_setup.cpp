#include "inslab/models/navigation/app_setup.hpp"

#include <algorithm>

#include "inslab/models/navigation/matching_barometer.hpp"
#include "inslab/models/navigation/matching_gravity.hpp"
#include "inslab/models/navigation/matching_heading.hpp"
#include "inslab/models/navigation/matching_magnetometer.hpp"
#include "inslab/models/navigation/matching_odometer.hpp"
#include "inslab/models/navigation/matching_parameters.hpp"
#include "inslab/models/navigation/parameters_file.hpp"

namespace inslab::navigation {

namespace {

/// Parameters know the odometers' streams by the scenario's word alone.
NavigationParameters with_numbers(NavigationParameters parameters, const scenario::ReferenceNav& app) {
  parameters.odometer.number = app.odometer;
  parameters.other_odometer.number = app.other_odometer;
  return parameters;
}

}  // namespace

AppSetup setup_for(const scenario::LoadedScenario& scenario, const scenario::ReferenceNav& app) {
  const scenario::LoadedImu& imu = scenario.sensor<catalog::Imu>(app.imu);
  const scenario::LoadedGnss& gnss = scenario.sensor<catalog::Gnss>(app.gnss);
  if (!app.parameters.empty()) {
    const std::string file = (scenario.file.parent_path() / app.parameters).string();
    NavigationParameters parameters = with_numbers(read_parameters(file), app);
    if (app.gravity_disturbance) parameters.states.gravity_disturbance = true;
    return {parameters, scenario.gravity_model(), app, {}};
  }
  const NavigationParameters of_imu =
      matching_parameters(imu.errors, imu.nominal_installation, gnss.nominal_installation);
  AppSetup setup{with_numbers(of_imu, app), scenario.gravity_model(), app, {}};
  if (const auto along_way = scenario.gravity_along_way(); along_way && app.gravity_disturbance) {
    match(*along_way, setup.parameters);
  }
  const auto note_left_out = [&setup](const catalog::AnyProfile& profile) {
    for (const std::string& name : left_out_of_matching(profile)) {
      const auto& named = setup.left_out;
      if (std::find(named.begin(), named.end(), name) == named.end()) setup.left_out.push_back(name);
    }
  };
  note_left_out(imu.errors);
  note_left_out(imu.vibration);
  note_left_out(gnss.errors);
  for_each(scenario::AidKinds{}, [&](auto tag) {
    using Kind = typename decltype(tag)::type;
    scenario::for_each_of_the_app<Kind>(app, [&](std::string_view, std::uint32_t number) {
      const auto& aid = scenario.sensor<Kind>(number);
      match(aid.errors, aid.nominal_installation, imu.nominal_installation, setup.parameters);
      note_left_out(aid.errors);
    });
  });
  return setup;
}

}  // namespace inslab::navigation
