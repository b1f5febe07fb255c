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
#include "services/inslab/swap_client.hpp"

namespace inslab::cli {

namespace {

struct SwapOptions {
  std::string kind;
  std::string profile;
  std::string sensor_kind;
  std::uint32_t sensor_number = 0;
  double at_s = -1.0;
  std::string continuity = "keep";
  double fade_s = 0.0;
  double timeout_s = 10.0;
  app::NetworkOptions network;
};

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
  const auto kind = value_named<ProfileKind>(options.kind);
  const std::string sensor_kind =
      !options.sensor_kind.empty() ? options.sensor_kind : (kind == ProfileKind::GnssError ? "gnss" : "imu");
  AnyProfile request =
      scenario::load_profile(options.profile, kind, {value_named<SensorKind>(sensor_kind), options.sensor_number});
  ProfileRequest& head = request_of(request);
  std::random_device random;
  head.request_id = (static_cast<std::uint64_t>(random()) << 32) | random();
  head.apply_at_ns = options.at_s < 0.0 ? -1 : time::from_seconds(options.at_s).count();
  head.continuity = value_named<Continuity>(options.continuity);
  head.fade_s = options.fade_s;
  return request;
}

/// Waits until `condition` holds; false at the deadline or at a signal.
template <class Condition>
bool wait_for(time::Nanoseconds deadline, const Condition& condition) {
  while (!condition()) {
    if (app::monotonic_now() > deadline || app::shutdown_requested()) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

int swap(const SwapOptions& options) {
  const AnyProfile request = request_for(options);
  dds::Participant participant(app::participant_options(options.network, "inslab-swap"));
  SwapClient client(participant);
  const time::Nanoseconds deadline = app::monotonic_now() + time::from_seconds(options.timeout_s);
  if (!wait_for(deadline, [&] { return client.connected(); })) {
    fmt::print(stderr, "inslab swap: no trajectory server was found\n");
    return app::kNotApplied;
  }
  if (!client.send(request) ||
      !wait_for(deadline, [&] { return !client.acks(request_of(request).request_id).empty(); })) {
    fmt::print(stderr, "inslab swap: no acknowledgement within {} s\n", options.timeout_s);
    return app::kNotApplied;
  }
  const ProfileAck ack = client.acks(request_of(request).request_id).front();
  if (ack.outcome == AckOutcome::Rejected) {
    fmt::print(stderr, "rejected: {}: {}\n", ack.field, ack.reason);
    return app::kNotApplied;
  }
  fmt::print("{} at {:.9f} s; first sample under it {:.9f} s, sequence {}{}\n", enum_name(ack.outcome),
             static_cast<double>(ack.apply_time_ns) * 1e-9, static_cast<double>(ack.first_sample_time_ns) * 1e-9,
             ack.first_sequence, ack.requested_in_the_past ? "; the time asked for had passed" : "");
  return ack.outcome == AckOutcome::Superseded ? app::kNotApplied : app::kOk;
}

}  // namespace

void add_swap(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<SwapOptions>();
  CLI::App* command = app.add_subcommand("swap", "Swap a profile of a running set; waits for the acknowledgement");
  command->add_option("kind", options->kind, "imu_error, vibration, installation, gnss_error or fault")
      ->required()
      ->check(CLI::IsMember(names_of<ProfileKind>()));
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
  command->callback([options, &action] { action = [options] { return swap(*options); }; });
}

}  // namespace inslab::cli
