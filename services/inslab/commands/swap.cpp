#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <random>
#include <thread>

#include "inslab/bus/client/run_client.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/foundation/host/command_ending.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/one_of.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/scenario/document_kind.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

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
  std::optional<double> timeout_s;  ///< absent: as long as the run goes on
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
  const ProfileKind kind = scenario::profile_kind_named(options.kind).value();
  const SensorKind sensor =
      options.sensor_kind.empty() ? catalog::usual_sensor(kind) : value_named<SensorKind>(options.sensor_kind);
  AnyProfile request = scenario::load_profile(options.profile, kind, {sensor, options.sensor_number});
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
    fmt::print(stderr, "rejected: {}: {}\n", text::shown(ack.field), text::shown(ack.reason));
    return false;
  }
  fmt::print("{} at {:.9f} s; first sample under it {:.9f} s, sequence {}{}\n", enum_name(ack.outcome),
             static_cast<double>(ack.apply_time_ns) * 1e-9, static_cast<double>(ack.first_sample_time_ns) * 1e-9,
             ack.first_sequence, ack.requested_in_the_past ? "; the time asked for had passed" : "");
  return ack.outcome != AckOutcome::Superseded;
}

/// How long to wait for acknowledgements: so many seconds in all when they are given, else as long as the run goes on
/// and a while beyond its last word, since a swap in the future is acknowledged by its first sample.
class Patience {
 public:
  explicit Patience(std::optional<double> timeout_s)
      : limited_(timeout_s.has_value()),
        end_(app::monotonic_now() + time::from_seconds(timeout_s.value_or(kBeyond_s))) {}

  time::Nanoseconds end() const { return end_; }
  bool is_over() const { return app::monotonic_now() > end_; }
  /// The run is going on: `statuses` have come of it.
  void hear(const RunClient& client) {
    const std::uint64_t statuses = client.statuses();
    const auto status = client.status();
    if (status && run_id_ == RunId{}) run_id_ = status->run_id;
    const bool ended = status && (has_ended(status->state) || status->run_id != run_id_);
    const bool going_on = statuses != statuses_ && status && !ended;
    if (going_on && !limited_) end_ = app::monotonic_now() + time::from_seconds(kBeyond_s);
    // What was said before the end may still be on its way.
    if (ended && !ended_) end_ = std::min(end_, app::monotonic_now() + std::chrono::seconds(2));
    ended_ = ended_ || ended;
    statuses_ = statuses;
  }

 private:
  static constexpr double kBeyond_s = 10.0;
  bool limited_;
  bool ended_ = false;
  time::Nanoseconds end_;
  std::uint64_t statuses_ = 0;
  RunId run_id_;  ///< the run that is waited for
};

std::string words_of_wait(const AnyProfile& request, const RunClient& client) {
  const std::int64_t at_ns = request_of(request).apply_at_ns;
  std::string words = "the first sample of " + sensor_name(target_of(request)) + " under the swap";
  if (at_ns >= 0) words += fmt::format(" at {:g} s", static_cast<double>(at_ns) * 1e-9);
  if (const auto status = client.status()) {
    words += fmt::format("; the run is {} at {:.1f} s", enum_name(status->state),
                         static_cast<double>(status->sim_time_ns) * 1e-9);
  }
  return words;
}

/// Waits for what becomes of a request; nothing when patience ends or at a signal.
std::optional<ProfileAck> await_ack(const AnyProfile& request, const RunClient& client, Patience& patience) {
  const std::uint64_t id = request_of(request).request_id;
  LongWait wait;
  for (auto acks = client.acks(id);; acks = client.acks(id)) {
    if (!acks.empty()) return acks.front();
    if (app::shutdown_requested() || patience.is_over()) return std::nullopt;
    patience.hear(client);
    wait.tell(words_of_wait(request, client));
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

/// Sends the requests and waits for what becomes of each.
int send_all(const std::vector<AnyProfile>& requests, const SwapOptions& options) {
  const app::OwnEnding leaves_the_domain(app::OwnEnding::Then::EndsBySignal);
  dds::Participant participant(app::participant_options(options.network, "inslab-swap"));
  RunClient client(participant);
  Patience patience(options.timeout_s);
  const std::string server = "a trajectory server on " + options.network.words();
  if (!wait_for(
          patience.end(), [&] { return client.connected(); }, server)) {
    fmt::print(stderr, "inslab swap: {} was not found\n", server);
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
    const auto ack = await_ack(request, client, patience);
    if (!ack) {
      fmt::print(stderr, "inslab swap: not acknowledged: {} did not come\n", words_of_wait(request, client));
      return app::kNotApplied;
    }
    good = report(*ack) && good;
  }
  return good ? app::kOk : app::kNotApplied;
}

void add_timeout(CLI::App& command, SwapOptions& options) {
  command
      .add_option("--timeout", options.timeout_s,
                  "seconds to wait in all; absent: as long as the run goes on, and 10 s beyond its last word")
      ->check(CLI::Range(0.0, 1e6));
}

}  // namespace

void add_swap(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<SwapOptions>();
  CLI::App* command = app.add_subcommand("swap", "Swap a profile of a running set; waits for the acknowledgement");
  command
      ->add_option("kind", options->kind, "imu_error (or imu), vibration, installation, gnss_error (or gnss) or fault")
      ->required()
      ->check(app::one_of(scenario::profile_kind_words()));
  command->add_option("profile", options->profile, "profile file (JSON)")->required();
  command->add_option("--sensor-kind", options->sensor_kind, "imu or gnss; installation and fault want it")
      ->check(app::one_of(names_of<SensorKind>()));
  command->add_option("--sensor", options->sensor_number, "number of the sensor")->capture_default_str();
  command->add_option("--at", options->at_s, "sim time in seconds; absent: as soon as possible");
  command->add_option("--continuity", options->continuity, "keep, reset or redraw")
      ->check(app::one_of(names_of<Continuity>()))
      ->capture_default_str();
  command->add_option("--fade", options->fade_s, "vibration: seconds of smooth fade")->capture_default_str();
  add_timeout(*command, *options);
  options->network.add_to(*command);
  command->callback([options, &action] {
    const bool is_of_either = options->kind == "installation" || options->kind == "fault";
    if (is_of_either && options->sensor_kind.empty()) {
      throw CLI::ValidationError("--sensor-kind",
                                 options->kind + " profiles go to IMUs and receivers: say imu or gnss");
    }
    action = [options] { return send_all({request_for(*options)}, *options); };
  });
}

void add_schedule(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<SwapOptions>();
  CLI::App* command =
      app.add_subcommand("schedule", "Play a list of swaps on a running set; waits for every acknowledgement");
  command->add_option("file", options->profile, "schedule (JSON): {\"swaps\": [...]} as in a scenario")->required();
  command->add_flag("--scenario", options->is_scenario, "the file is a scenario: play its swaps");
  add_timeout(*command, *options);
  options->network.add_to(*command);
  command->callback([options, &action] {
    action = [options] {
      const std::vector<AnyProfile> swaps = options->is_scenario
                                                ? scenario::load(options->profile).swaps
                                                : scenario::load_schedule(options->profile, app::random_id());
      return send_all(swaps, *options);
    };
  });
}

}  // namespace inslab::cli
