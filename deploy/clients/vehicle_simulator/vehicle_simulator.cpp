// An example of a dynamics simulator in the loop: Fast DDS, the types generated from idl/vehicle.idl and
// idl/control.idl, and nothing else of the simulator.
//
// A car starts at rest at the place that tests/data/live.json names and follows its own little autopilot: a speed and a
// yaw rate are wanted, and reached with a lag. Its states go out on inslab/vehicle_state until the run ends. For tests
// of the link the states can be held back, lost at random, or silent for a while.
//
//   vehicle_simulator [--domain N] [--rate HZ] [--jitter MS] [--loss SHARE] [--silence FROM_S LENGTH_S] [--seed N]
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <iostream>
#include <map>
#include <random>
#include <string>
#include <thread>

#if __has_include(<fastdds/utils/IPLocator.hpp>)  // Fast DDS 3.x and its generator
#include "controlPubSubTypes.hpp"
#include "vehiclePubSubTypes.hpp"
#else  // 2.x
#include "controlPubSubTypes.h"
#include "vehiclePubSubTypes.h"
#endif

using namespace eprosima::fastdds::dds;
#if !__has_include(<fastdds/utils/IPLocator.hpp>)
constexpr auto RETCODE_OK = ReturnCode_t::RETCODE_OK;
#endif
namespace types = inslab::v5;  // the wire types' version, in one place

namespace {

constexpr double kPi = 3.14159265358979323846;

struct Options {
  int domain = 0;
  double rate_hz = 100.0;
  double jitter_ms = 0.0;
  double loss = 0.0;
  double silence_from_s = 0.0;
  double silence_s = 0.0;
  unsigned seed = 1;
};

bool parse(int argc, char** argv, Options& options) {
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    const bool is_silence = name == "--silence";
    if (i + (is_silence ? 2 : 1) >= argc) return false;
    const double value = std::atof(argv[++i]);
    if (name == "--domain") {
      options.domain = static_cast<int>(value);
    } else if (name == "--rate") {
      options.rate_hz = value;
    } else if (name == "--jitter") {
      options.jitter_ms = value;
    } else if (name == "--loss") {
      options.loss = value;
    } else if (name == "--seed") {
      options.seed = static_cast<unsigned>(value);
    } else if (is_silence) {
      options.silence_from_s = value;
      options.silence_s = std::atof(argv[++i]);
    } else {
      return false;
    }
  }
  return options.rate_hz >= 10.0 && options.rate_hz <= 1000.0;
}

/// A car on level ground: speed and yaw rate follow what is wanted with lags of 1.0 s and 0.3 s.
class Car {
 public:
  /// Goes on to `t_s` in steps of a millisecond, with Runge-Kutta's method.
  void advance_to(double t_s) {
    constexpr double kStep_s = 1e-3;
    while (t_ + 0.5 * kStep_s < t_s) {
      step(kStep_s);
      t_ += kStep_s;
    }
  }

  types::VehicleState state() const {
    const State d = rates(t_, x_);
    const double c = std::cos(x_.yaw), s = std::sin(x_.yaw);
    types::VehicleState state;
    state.latitude_rad(x_.latitude);
    state.longitude_rad(x_.longitude);
    state.height_m(kHeight_m);
    state.v_n_m_per_s({x_.speed * c, x_.speed * s, 0.0});
    state.a_n_m_per_s2({d.speed * c - x_.speed * d.yaw * s, d.speed * s + x_.speed * d.yaw * c, 0.0});
    state.q_nv({std::cos(0.5 * x_.yaw), 0.0, 0.0, std::sin(0.5 * x_.yaw)});
    state.omega_nv_v_rad_per_s({0.0, 0.0, x_.yaw_rate});
    return state;
  }

 private:
  static constexpr double kHeight_m = 500.0;
  struct State {
    double latitude = 48.0 * kPi / 180.0;
    double longitude = 11.0 * kPi / 180.0;
    double speed = 0.0;
    double yaw = 60.0 * kPi / 180.0;
    double yaw_rate = 0.0;

    State plus(const State& rate, double dt) const {
      return {latitude + dt * rate.latitude, longitude + dt * rate.longitude, speed + dt * rate.speed,
              yaw + dt * rate.yaw, yaw_rate + dt * rate.yaw_rate};
    }
  };

  /// Time derivatives.
  static State rates(double t_s, const State& x) {
    constexpr double a = 6378137.0, e2 = 6.69437999014e-3;  // WGS-84
    const double w2 = 1.0 - e2 * std::sin(x.latitude) * std::sin(x.latitude);
    const double transverse = a / std::sqrt(w2) + kHeight_m;
    const double meridian = a * (1.0 - e2) / (w2 * std::sqrt(w2)) + kHeight_m;
    const double wanted_speed = 15.0 * (1.0 - std::exp(-0.5 * t_s));
    const double wanted_yaw_rate = 0.3 * std::sin(0.8 * t_s);
    return {x.speed * std::cos(x.yaw) / meridian, x.speed * std::sin(x.yaw) / (transverse * std::cos(x.latitude)),
            (wanted_speed - x.speed) / 1.0, x.yaw_rate, (wanted_yaw_rate - x.yaw_rate) / 0.3};
  }

  void step(double dt) {
    const State k1 = rates(t_, x_);
    const State k2 = rates(t_ + 0.5 * dt, x_.plus(k1, 0.5 * dt));
    const State k3 = rates(t_ + 0.5 * dt, x_.plus(k2, 0.5 * dt));
    const State k4 = rates(t_ + dt, x_.plus(k3, dt));
    x_ = x_.plus(k1, dt / 6.0).plus(k2, dt / 3.0).plus(k3, dt / 3.0).plus(k4, dt / 6.0);
  }

  double t_ = 0.0;
  State x_;
};

/// What the simulator must know of the run: its time, from the marks that pair it with the wall clock, and its end.
class Run : public DataReaderListener {
 public:
  void on_data_available(DataReader* reader) override {
    SampleInfo info;
    if (reader->get_topicdescription()->get_name() == "inslab/time_mark") {
      types::TimeMark mark;
      while (reader->take_next_sample(&mark, &info) == RETCODE_OK) {
        if (info.valid_data) zero_ns_ = mark.realtime_ns() - mark.sim_time_ns();
      }
      return;
    }
    types::SimStatus status;
    while (reader->take_next_sample(&status, &info) == RETCODE_OK) {
      if (info.valid_data) state_ = static_cast<int>(status.state());
    }
  }
  void on_subscription_matched(DataReader* reader, const SubscriptionMatchedStatus& status) override {
    if (reader->get_topicdescription()->get_name() == "inslab/time_mark") hears_marks_ = status.current_count > 0;
  }

  bool hears_marks() const { return hears_marks_; }
  bool has_time() const { return zero_ns_ != 0; }
  bool ended() const { return state_ > static_cast<int>(types::RunState::RUN_RUNNING); }
  std::int64_t sim_time_ns() const { return realtime_ns() - zero_ns_; }

 private:
  static std::int64_t realtime_ns() {
    return std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
  }
  std::atomic<bool> hears_marks_{false};
  std::atomic<std::int64_t> zero_ns_{0};
  std::atomic<int> state_{0};
};

/// Sends states with the troubles that the options ask for, until the run ends.
class Sender {
 public:
  Sender(const Options& options, DataWriter* writer) : options_(options), writer_(writer), random_(options.seed) {}

  void follow(const Run& run) {
    const double period_s = 1.0 / options_.rate_hz;
    for (std::uint64_t number = 1; !run.ended(); ++number) {
      const double t_s = static_cast<double>(number) * period_s;
      while (static_cast<double>(run.sim_time_ns()) * 1e-9 < t_s && !run.ended()) {
        send_due(run.sim_time_ns());
        std::this_thread::sleep_for(std::chrono::microseconds(200));
      }
      car_.advance_to(t_s);
      types::VehicleState state = car_.state();
      state.sequence_number(number);
      state.sim_time_ns(static_cast<std::int64_t>(std::llround(t_s * 1e9)));
      hold(state, t_s);
    }
  }

  std::uint64_t sent() const { return sent_; }
  std::uint64_t withheld() const { return withheld_; }

 private:
  void hold(const types::VehicleState& state, double t_s) {
    const bool silent = t_s >= options_.silence_from_s && t_s < options_.silence_from_s + options_.silence_s;
    const bool lost = std::bernoulli_distribution(options_.loss)(random_);
    const double delay_s = std::uniform_real_distribution<double>(0.0, 1e-3 * options_.jitter_ms)(random_);
    if (silent || lost) {
      ++withheld_;
    } else {
      held_.emplace(state.sim_time_ns() + static_cast<std::int64_t>(1e9 * delay_s), state);
    }
  }

  void send_due(std::int64_t sim_time_ns) {
    while (!held_.empty() && held_.begin()->first <= sim_time_ns) {
      writer_->write(&held_.begin()->second);
      held_.erase(held_.begin());
      ++sent_;
    }
  }

  Options options_;
  DataWriter* writer_;
  std::mt19937 random_;
  Car car_;
  std::multimap<std::int64_t, types::VehicleState> held_;  ///< by the sim time at which they go out
  std::uint64_t sent_ = 0;
  std::uint64_t withheld_ = 0;
};

template <class Type>
Topic* topic(DomainParticipant* participant, const char* name) {
  TypeSupport type(new Type());
  type.register_type(participant);
  return participant->create_topic(name, type.get_type_name(), TOPIC_QOS_DEFAULT);
}

}  // namespace

int main(int argc, char** argv) {
  constexpr const char* kUsage =
      "usage: vehicle_simulator [--domain N] [--rate HZ, 10 to 1000] [--jitter MS] [--loss SHARE] "
      "[--silence FROM_S LENGTH_S] [--seed N]; it ends with the run\n";
  if (argc == 2 && (std::string(argv[1]) == "--help" || std::string(argv[1]) == "-h")) {
    std::cout << kUsage;
    return 0;
  }
  Options options;
  if (!parse(argc, argv, options)) {
    std::cerr << kUsage;
    return 2;
  }
  auto* factory = DomainParticipantFactory::get_instance();
  // PARTICIPANT_QOS_DEFAULT is what FASTRTPS_DEFAULT_PROFILES_FILE says, if it is set.
  auto* participant = factory->create_participant(static_cast<DomainId_t>(options.domain), PARTICIPANT_QOS_DEFAULT);
  auto* subscriber = participant->create_subscriber(SUBSCRIBER_QOS_DEFAULT);
  auto* publisher = participant->create_publisher(PUBLISHER_QOS_DEFAULT);

  Run run;
  DataReaderQos mark_qos = DATAREADER_QOS_DEFAULT;
  mark_qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
  subscriber->create_datareader(topic<types::TimeMarkPubSubType>(participant, "inslab/time_mark"), mark_qos, &run);
  DataReaderQos status_qos = mark_qos;
  status_qos.durability().kind = TRANSIENT_LOCAL_DURABILITY_QOS;
  subscriber->create_datareader(topic<types::SimStatusPubSubType>(participant, "inslab/sim/status"), status_qos, &run);

  // The run begins when it sees a writer of states. There is none before the first time mark can be heard.
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  const auto wait_for = [&](auto condition) {
    while (!condition() && std::chrono::steady_clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return condition();
  };
  bool good = wait_for([&] { return run.hears_marks(); });
  DataWriterQos state_qos = DATAWRITER_QOS_DEFAULT;
  state_qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
  state_qos.publish_mode().kind = SYNCHRONOUS_PUBLISH_MODE;
  state_qos.history().depth = 1000;
  Sender sender(options, publisher->create_datawriter(
                             topic<types::VehicleStatePubSubType>(participant, "inslab/vehicle_state"), state_qos));
  good = good && wait_for([&] { return run.has_time() || run.ended(); });
  if (good) {
    sender.follow(run);
    std::cout << sender.sent() << " states sent, " << sender.withheld() << " withheld\n";
  } else {
    std::cerr << "no run began within a minute\n";
  }
  participant->delete_contained_entities();
  factory->delete_participant(participant);
  return good ? 0 : 1;
}
