#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/one_of.hpp"
#include "inslab/scenario/document_kind.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/services/inslab/commands/commands.hpp"
#include "inslab/services/inslab/commands/play.hpp"

namespace inslab::commands {

namespace {

constexpr double kLongestRunS = 1e9;

struct SwapOptions {
  std::string kind;
  std::string profile;
  std::string sensor_kind;
  std::uint32_t sensor_number = 0;
  std::optional<double> at_s;  ///< absent: as soon as possible
  std::string continuity = "keep";
  double fade_s = 0.0;
  PlayOptions play;
};

catalog::AnyProfile request_for(const SwapOptions& options) {
  const ProfileKind kind = scenario::profile_kind_named(options.kind).value();
  const SensorKind sensor =
      options.sensor_kind.empty() ? catalog::usual_sensor(kind) : enum_named<SensorKind>(options.sensor_kind).value();
  catalog::AnyProfile request = scenario::load_profile(options.profile, kind, {sensor, options.sensor_number});
  ProfileRequest& head = catalog::request_of(request);
  head.request_id = host::random_id();
  head.apply_at_ns = options.at_s ? time::from_seconds(*options.at_s).count() : -1;
  head.continuity = enum_named<Continuity>(options.continuity).value();
  head.fade_s = options.fade_s;
  return request;
}

/// Whether sensors of several kinds have such profiles, so that it must be said which is meant.
bool is_for_several_kinds(ProfileKind profile) {
  int kinds = 0;
  for_each(catalog::SensorKinds{},
           [&](auto sensor) { kinds += catalog::takes_profile(decltype(sensor)::type::kind, profile) ? 1 : 0; });
  return kinds > 1;
}

std::string those_for_several_kinds() {
  std::vector<std::string> names;
  for (const std::string& name : enum_words<ProfileKind>()) {
    if (is_for_several_kinds(enum_named<ProfileKind>(name).value())) names.push_back(name);
  }
  return fmt::format("{}", fmt::join(names, " and "));
}

}  // namespace

void add_swap(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<SwapOptions>();
  CLI::App* command = app.add_subcommand("swap", "Swap a profile of a running set; waits for the acknowledgement");
  command->add_option("kind", options->kind, "kind of profile, by its name or its short one")
      ->required()
      ->check(host::one_of(scenario::profile_kind_words()));
  command->add_option("profile", options->profile, "profile file (JSON)")->required();
  command
      ->add_option("--sensor-kind", options->sensor_kind,
                   "kind of sensor; wanted where several have such profiles: " + those_for_several_kinds())
      ->check(host::one_of(enum_words<SensorKind>()));
  command->add_option("--sensor", options->sensor_number, "number of the sensor")->capture_default_str();
  command->add_option("--at", options->at_s, "sim time in seconds; absent: as soon as possible")
      ->check(CLI::Range(0.0, kLongestRunS));
  command->add_option("--continuity", options->continuity, "keep, reset or redraw")
      ->check(host::one_of(enum_words<Continuity>()))
      ->capture_default_str();
  command->add_option("--fade", options->fade_s, "vibration: seconds of smooth fade")->capture_default_str();
  options->play.add_to(*command);
  command->callback([options, &action] {
    const ProfileKind kind = scenario::profile_kind_named(options->kind).value();
    if (is_for_several_kinds(kind) && options->sensor_kind.empty()) {
      throw CLI::ValidationError("--sensor-kind", "missing; expected " + catalog::wearers(kind) +
                                                      ", all of which have " + options->kind + " profiles");
    }
    action = [options] { return play_and_tell({request_for(*options)}, options->play); };
  });
}

}  // namespace inslab::commands
