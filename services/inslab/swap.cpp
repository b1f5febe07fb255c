#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <random>
#include <thread>

#include "app/exit_code.hpp"
#include "app/host.hpp"
#include "app/service.hpp"
#include "app/shutdown.hpp"
#include "services/inslab/commands.hpp"
#include "services/inslab/run_client.hpp"

namespace inslab::cli {

namespace {

struct SwapOptions {
  std::string kind;
  std::string profile;
  bool is_scenario = false;
  std::string sensor_kind;
  std::uint32_t sensor_number = 0;
  double at_s = -1.0;
  std::string continuity = "keep";
  double fade_s = 0.0;
  double timeout_s = 10.0;
  app::NetworkOptions network;
};

/// The kinds of profile as the command line has them, in the order of ProfileKind.
const std::vector<std::string> kKinds{"imu", "vibration", "installation", "gnss", "fault"};

template <class Enum>
Enum value_named(const std::string& name) {
  const auto& names = EnumNames<Enum>::values;
  return static_cast<Enum>(std::find(names.begin(), names.end(), name) - names.begin());
}

template <class Enum>
std::vector<std::string> names_of() {
  return {EnumNames<Enum>::values.begin(), EnumNames<Enum>::values.end()};
}

AnyProfile request_for(const SwapOptions& options) {
  const auto kind = static_cast<ProfileKind>(std::find(kKinds.begin(), kKinds.end(), options.kind) - kKinds.begin());
  const std::string sensor_kind =
      !options.sensor_kind.empty() ? options.sensor_kind : (kind == ProfileKind::GnssError ? "gnss" : "imu");
  AnyProfile request =
      scenario::load_profile(options.profile, kind, {value_named<SensorKind>(sensor_kind), options.sensor_number});
  ProfileRequest& head = request_of(request);
  head.request_id = app::random_id();
  head.apply_at_ns = options.at_s < 0.0 ? -1 : time::from_seconds(options.at_s).count();
  head.continuity = value_named<Continuity>(options.continuity);
  head.fade_s = options.fade_s;
  return request;
}

/// Says what became of a request; true when it is in effect.
bool report(const ProfileAck& ack) {
  if (ack.outcome == AckOutcome::Rejected) {
    fmt::print(stderr, "rejected: {}: {}\n", ack.field, ack.reason);
    return false;
  }
  fmt::print("{} at {:.9f} s; first sample under it {:.9f} s, sequence {}{}\n", enum_name(ack.outcome),
             static_cast<double>(ack.apply_time_ns) * 1e-9, static_cast<double>(ack.first_sample_time_ns) * 1e-9,
             ack.first_sequence, ack.requested_in_the_past ? "; the time asked for had passed" : "");
  return ack.outcome != AckOutcome::Superseded;
}

/// Sends the requests and waits for what becomes of each. `timeout_s` counts from the last word of the set.
int send_all(const std::vector<AnyProfile>& requests, double timeout_s, const app::NetworkOptions& network) {
  dds::Participant participant(app::participant_options(network, "inslab-swap"));
  RunClient client(participant);
  const time::Nanoseconds patience = time::from_seconds(timeout_s);
  if (!wait_for(app::monotonic_now() + patience, [&] { return client.connected(); })) {
    fmt::print(stderr, "inslab swap: no trajectory server was found\n");
    return app::kNotApplied;
  }
  for (const AnyProfile& request : requests) {
    if (!client.send(request)) {
      fmt::print(stderr, "inslab swap: a request could not be sent\n");
      return app::kNotApplied;
    }
  }
  bool good = true;
  for (const AnyProfile& request : requests) {
    const std::uint64_t id = request_of(request).request_id;
    // A swap in the future is acknowledged by its first sample: wait for as long as the run goes on.
    auto last_status = client.statuses();
    time::Nanoseconds deadline = app::monotonic_now() + patience;
    const auto has_run_ended = [&] { return client.status() && has_ended(client.status()->state); };
    bool ended = false;
    while (client.acks(id).empty() &&
           !wait_for(app::monotonic_now() + std::chrono::milliseconds(50), [&] { return !client.acks(id).empty(); })) {
      if (app::shutdown_requested()) return app::kNotApplied;
      if (has_run_ended() && !ended) {
        ended = true;  // what was said before the end may still be on its way
        deadline = std::min(deadline, app::monotonic_now() + std::chrono::seconds(2));
      }
      if (client.statuses() != last_status && !has_run_ended()) deadline = app::monotonic_now() + patience;
      last_status = client.statuses();
      if (app::monotonic_now() <= deadline) continue;
      if (ended) {
        fmt::print(stderr, "inslab swap: the run has ended ({}) and nothing has acknowledged the swap\n",
                   enum_name(client.status()->state));
      } else {
        fmt::print(stderr, "inslab swap: no acknowledgement within {} s\n", timeout_s);
      }
      return app::kNotApplied;
    }
    good = report(client.acks(id).front()) && good;
  }
  return good ? app::kOk : app::kNotApplied;
}

}  // namespace

void add_swap(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<SwapOptions>();
  CLI::App* command = app.add_subcommand("swap", "Swap a profile of a running set; waits for the acknowledgement");
  command->add_option("kind", options->kind, "imu, vibration, installation, gnss or fault")
      ->required()
      ->check(CLI::IsMember(kKinds));
  command->add_option("profile", options->profile, "profile file (JSON)")->required();
  command->add_option("--sensor-kind", options->sensor_kind, "imu or gnss; for installation and fault")
      ->check(CLI::IsMember(names_of<SensorKind>()));
  command->add_option("--sensor", options->sensor_number, "number of the sensor")->capture_default_str();
  command->add_option("--at", options->at_s, "sim time in seconds; absent: as soon as possible");
  command->add_option("--continuity", options->continuity, "keep, reset or redraw")
      ->check(CLI::IsMember(names_of<Continuity>()))
      ->capture_default_str();
  command->add_option("--fade", options->fade_s, "vibration: seconds of smooth fade")->capture_default_str();
  command->add_option("--timeout", options->timeout_s, "seconds to wait for the acknowledgement")
      ->capture_default_str();
  options->network.add_to(*command);
  command->callback([options, &action] {
    action = [options] { return send_all({request_for(*options)}, options->timeout_s, options->network); };
  });
}

void add_schedule(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<SwapOptions>();
  CLI::App* command =
      app.add_subcommand("schedule", "Play a list of swaps on a running set; waits for every acknowledgement");
  command->add_option("file", options->profile, "schedule (JSON): {\"swaps\": [...]} as in a scenario")->required();
  command->add_flag("--scenario", options->is_scenario, "the file is a scenario: play its swaps");
  command->add_option("--timeout", options->timeout_s, "seconds to wait after the last word of the set")
      ->capture_default_str();
  options->network.add_to(*command);
  command->callback([options, &action] {
    action = [options] {
      const std::vector<AnyProfile> swaps = options->is_scenario
                                                ? scenario::load(options->profile).swaps
                                                : scenario::load_schedule(options->profile, app::random_id());
      return send_all(swaps, options->timeout_s, options->network);
    };
  });
}

}  // namespace inslab::cli
