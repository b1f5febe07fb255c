// A flight computer's navigation app on Fast DDS, with nothing of the simulator but its IDL (compiled by fastddsgen).
// It navigates by GNSS alone: the newest fix, carried on by its velocity to the time of the newest IMU sample, and
// publishes one NavSolution for each IMU sample. A real app would put its mechanization and filter where solve() is.
//
//   fastdds_nav_client [--domain N] [--unit NAME] [--seconds S] [--values FILE] [--blocks 1]
//
// With --blocks 1 it takes part in lockstep at full speed: it reads the block topics, leaves the truth alone, and
// publishes one solution a block, whose imu_sequence is its credit.
//
// Ends with the run, whose end its status tells or the trajectory server's going; with --seconds after S seconds at the
// latest. Prints what came; --values writes every sample's sequence number and first values as hexadecimal floating
// point, for comparison with the log. Exit code 1 when a sequence number was missing or nothing came.
#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#if __has_include(<fastdds/utils/IPLocator.hpp>)  // Fast DDS 3.x and its generator
#include "blockPubSubTypes.hpp"
#include "controlPubSubTypes.hpp"
#include "gnssPubSubTypes.hpp"
#include "imuPubSubTypes.hpp"
#include "navPubSubTypes.hpp"
#include "truthPubSubTypes.hpp"
#else  // 2.x
#include "blockPubSubTypes.h"
#include "controlPubSubTypes.h"
#include "gnssPubSubTypes.h"
#include "imuPubSubTypes.h"
#include "navPubSubTypes.h"
#include "truthPubSubTypes.h"
#endif

using namespace eprosima::fastdds::dds;
#if !__has_include(<fastdds/utils/IPLocator.hpp>)
constexpr auto RETCODE_OK = ReturnCode_t::RETCODE_OK;
#endif
namespace types = inslab::v5;  // the wire types' version, in one place

namespace {

constexpr const char* kHelp =
    "A navigation app on Fast DDS that navigates by GNSS alone; ends with the run.\n"
    "Usage: fastdds_nav_client [OPTIONS]\n\n"
    "  --domain N      DDS domain (default 0)\n"
    "  --unit NAME     the unit: the DDS partition (default none)\n"
    "  --seconds S     end after S seconds, should the run go on longer (default: with the run)\n"
    "  --values FILE   write what comes, for comparison with the log\n"
    "  --blocks 1      take part in lockstep at full speed: read blocks of samples\n"
    "  -h, --help      print this\n";

struct Options {
  DomainId_t domain = 0;
  std::string unit;
  std::optional<double> seconds;
  std::string values;
  bool blocks = false;
};

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    if (name == "--help" || name == "-h") {
      std::fputs(kHelp, stdout);
      std::exit(0);
    }
    const bool known =
        name == "--domain" || name == "--unit" || name == "--seconds" || name == "--values" || name == "--blocks";
    if (!known) throw std::runtime_error("unknown option " + name + "; --help lists them");
    if (i + 1 == argc) throw std::runtime_error(name + " needs a value; --help says which");
    const std::string value = argv[i + 1];
    if (name == "--domain") {
      options.domain = static_cast<DomainId_t>(std::stoul(value));
    } else if (name == "--unit") {
      options.unit = value;
    } else if (name == "--seconds") {
      options.seconds = std::stod(value);
    } else if (name == "--values") {
      options.values = value;
    } else {
      options.blocks = value != "0";
    }
  }
  return options;
}

// The participant, and what is made of it.
class Bus {
 public:
  explicit Bus(const Options& options)
      // PARTICIPANT_QOS_DEFAULT is what FASTRTPS_DEFAULT_PROFILES_FILE says, if it is set.
      : participant_(
            DomainParticipantFactory::get_instance()->create_participant(options.domain, PARTICIPANT_QOS_DEFAULT)) {
    if (participant_ == nullptr) throw std::runtime_error("no participant");
    SubscriberQos subscriber_qos = SUBSCRIBER_QOS_DEFAULT;
    PublisherQos publisher_qos = PUBLISHER_QOS_DEFAULT;
    if (!options.unit.empty()) {
      subscriber_qos.partition().push_back(options.unit.c_str());
      publisher_qos.partition().push_back(options.unit.c_str());
    }
    subscriber_ = participant_->create_subscriber(subscriber_qos);
    publisher_ = participant_->create_publisher(publisher_qos);
  }
  ~Bus() {
    participant_->delete_contained_entities();
    DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  template <class PubSubType>
  DataReader* reader(const std::string& name, int depth, bool latched = false) {
    DataReaderQos qos = DATAREADER_QOS_DEFAULT;
    qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
    qos.history().depth = depth;
    if (latched) qos.durability().kind = TRANSIENT_LOCAL_DURABILITY_QOS;
    return subscriber_->create_datareader(topic<PubSubType>(name), qos);
  }
  template <class PubSubType>
  DataWriter* writer(const std::string& name) {
    DataWriterQos qos = DATAWRITER_QOS_DEFAULT;
    qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
    qos.history().depth = 1000;
    return publisher_->create_datawriter(topic<PubSubType>(name), qos);
  }

 private:
  template <class PubSubType>
  Topic* topic(const std::string& name) {
    TypeSupport type(new PubSubType());
    type.register_type(participant_);
    return participant_->create_topic(name, type.get_type_name(), TOPIC_QOS_DEFAULT);
  }

  DomainParticipant* participant_;
  Subscriber* subscriber_;
  Publisher* publisher_;
};

// Calls `each` with every sample that waits in a reader.
template <class Sample, class Each>
void take_all(DataReader& reader, const Each& each) {
  Sample sample;
  SampleInfo info;
  while (reader.take_next_sample(&sample, &info) == RETCODE_OK) {
    if (info.valid_data) each(sample);
  }
}

struct Count {
  std::uint64_t received = 0;
  std::uint64_t next = 0;
  std::uint64_t missing = 0;

  void add(std::uint64_t sequence) {
    if (sequence >= next) {
      missing += sequence - next;
      next = sequence + 1;
    } else if (missing > 0) {
      --missing;
    } else {
      return;  // it has come before, and was sent again for somebody else
    }
    ++received;
  }
  bool print(const char* topic) const {
    std::printf("%s: %" PRIu64 " samples, %" PRIu64 " missing\n", topic, received, missing);
    return received > 0 && missing == 0;
  }
};

// When to end: with the run. Says after two seconds that it waits for one.
class RunFollower {
 public:
  RunFollower(const Options& options, DataReader& status_reader)
      : options_(options), status_reader_(status_reader), begun_(Clock::now()) {}

  // Takes what has come of the run's status. `next_truth` follows the newest truth sample that has come, `received`
  // counts the samples of all streams.
  bool is_over(std::uint64_t next_truth, std::uint64_t received) {
    take_all<types::SimStatus>(status_reader_, [this](const types::SimStatus& status) {
      const bool ended = status.state() >= types::RunState::RUN_FINISHED;
      running_ = running_ || !ended;
      end_heard_ = ended ? std::optional<std::uint64_t>(status.truth_samples()) : std::nullopt;
    });
    // The end of a run that was over before this app came is not the end that it waits for. A short run may be over
    // before its status was read; its samples tell that it was there.
    running_ = running_ || received > 0;
    if (end_heard_ && running_ && !truth_sent_) end_with(*end_heard_);
    SubscriptionMatchedStatus matched;
    status_reader_.get_subscription_matched_status(matched);
    if (running_ && !truth_sent_ && matched.current_count == 0) end_with(0);  // the server was killed
    const Clock::time_point now = Clock::now();
    if (received != received_) came_ = now;
    received_ = received;
    if (!running_ && !told_ && now - begun_ > std::chrono::seconds(2)) {
      told_ = true;
      std::fprintf(stderr, "waits for a run on domain %u%s%s\n", static_cast<unsigned>(options_.domain),
                   options_.unit.empty() ? "" : ", unit ", options_.unit.c_str());
    }
    if (options_.seconds && std::chrono::duration<double>(now - begun_).count() > *options_.seconds) return true;
    if (!truth_sent_) return false;
    // What is still on its way has this long to come after what came last, and more when it is known that it must.
    const auto patience = std::chrono::milliseconds(next_truth >= *truth_sent_ ? 500 : 3000);
    return now - std::max(ended_, came_) > patience;
  }

 private:
  using Clock = std::chrono::steady_clock;
  void end_with(std::uint64_t truth_samples) {
    truth_sent_ = truth_samples;
    ended_ = Clock::now();
  }

  const Options& options_;
  DataReader& status_reader_;
  Clock::time_point begun_;
  Clock::time_point ended_;
  Clock::time_point came_;  // when a sample came last
  std::uint64_t received_ = 0;
  std::optional<std::uint64_t> end_heard_;   // the newest status is of a run's end: its truth samples
  std::optional<std::uint64_t> truth_sent_;  // in the whole run, when it has ended
  bool running_ = false;
  bool told_ = false;
};

// The newest fix, carried on to the time of the IMU sample; initializing until there is one.
types::NavSolution solve(const std::optional<types::GnssFix>& fix, const types::ImuSample& imu) {
  types::NavSolution nav;
  nav.gps_week(imu.header().gps_week());
  nav.gps_time_of_week_ns(imu.header().gps_time_of_week_ns());
  nav.imu_sequence(imu.header().sequence_number());
  nav.q_n_body({1.0, 0.0, 0.0, 0.0});
  nav.mode(types::NavMode::NAV_MODE_INITIALIZING);
  if (!fix) return nav;
  constexpr double kSemiMajorAxis_m = 6378137.0;  // WGS-84; a sphere is near enough to carry a fix on for a second
  const double age_s =
      static_cast<double>(imu.header().gps_time_of_week_ns() - fix->header().gps_time_of_week_ns()) * 1e-9;
  nav.mode(types::NavMode::NAV_MODE_NAVIGATING);
  nav.reference_point(types::ReferencePoint::REFERENCE_ANTENNA);
  nav.latitude_rad(fix->latitude_rad() + fix->v_n_m_per_s()[0] * age_s / kSemiMajorAxis_m);
  nav.longitude_rad(fix->longitude_rad() +
                    fix->v_n_m_per_s()[1] * age_s / (kSemiMajorAxis_m * std::cos(fix->latitude_rad())));
  nav.height_m(fix->height_m() - fix->v_n_m_per_s()[2] * age_s);
  nav.v_n_m_per_s(fix->v_n_m_per_s());
  nav.position_sigma_ned_m(fix->position_sigma_ned_m());
  nav.velocity_sigma_ned_m_per_s(fix->velocity_sigma_ned_m_per_s());
  nav.attitude_sigma_rad({3.2, 3.2, 3.2});  // GNSS alone knows no attitude
  return nav;
}

// Lockstep at full speed. Exit code 0 when nothing was missing.
int navigate_in_blocks(const Options& options) {
  Bus bus(options);
  DataReader* imu_reader = bus.reader<types::ImuBlockPubSubType>("inslab/block/imu/0", 256);
  DataReader* gnss_reader = bus.reader<types::GnssBlockPubSubType>("inslab/block/gnss/0", 256);
  DataReader* status_reader = bus.reader<types::SimStatusPubSubType>("inslab/sim/status", 1, true);
  DataWriter* nav_writer = bus.writer<types::NavSolutionPubSubType>("inslab/nav");
  Count imu, gnss;
  std::optional<types::GnssFix> fix;
  RunFollower run(options, *status_reader);
  while (!run.is_over(std::numeric_limits<std::uint64_t>::max(), imu.received + gnss.received)) {
    imu_reader->wait_for_unread_message({0, 50'000'000});
    take_all<types::GnssBlock>(*gnss_reader, [&](const types::GnssBlock& block) {
      for (const types::GnssFix& sample : block.samples()) {
        gnss.add(sample.header().sequence_number());
        if (sample.fix_type() != types::FixType::FIX_NONE) fix = sample;
      }
    });
    take_all<types::ImuBlock>(*imu_reader, [&](const types::ImuBlock& block) {
      for (const types::ImuSample& sample : block.samples()) imu.add(sample.header().sequence_number());
      if (block.samples().empty()) return;
      types::NavSolution nav = solve(fix, block.samples().back());
      nav_writer->write(&nav);
    });
  }
  const bool whole_imu = imu.print("inslab/block/imu/0");
  const bool whole_gnss = gnss.print("inslab/block/gnss/0");
  return whole_imu && whole_gnss ? 0 : 1;
}

int navigate(const Options& options) {
  std::FILE* values = options.values.empty() ? nullptr : std::fopen(options.values.c_str(), "w");
  if (!options.values.empty() && values == nullptr) throw std::runtime_error(options.values + ": cannot be written");
  const auto note = [values](const char* topic, std::uint64_t sequence, double first, double second) {
    if (values != nullptr) std::fprintf(values, "%s %" PRIu64 " %a %a\n", topic, sequence, first, second);
  };
  Bus bus(options);
  DataReader* truth_reader = bus.reader<types::TruthStatePubSubType>("inslab/truth", 1000);
  DataReader* imu_reader = bus.reader<types::ImuSamplePubSubType>("inslab/imu/0", 1000);
  DataReader* gnss_reader = bus.reader<types::GnssFixPubSubType>("inslab/gnss/0", 1000);
  DataReader* status_reader = bus.reader<types::SimStatusPubSubType>("inslab/sim/status", 1, true);
  DataWriter* nav_writer = bus.writer<types::NavSolutionPubSubType>("inslab/nav");

  Count truth, imu, gnss;
  std::optional<types::GnssFix> fix;
  std::uint64_t published = 0;
  RunFollower run(options, *status_reader);
  while (!run.is_over(truth.next, truth.received + imu.received + gnss.received)) {
    imu_reader->wait_for_unread_message({0, 50'000'000});
    take_all<types::GnssFix>(*gnss_reader, [&](const types::GnssFix& sample) {
      gnss.add(sample.header().sequence_number());
      note("gnss", sample.header().sequence_number(), sample.latitude_rad(), sample.height_m());
      if (sample.fix_type() != types::FixType::FIX_NONE) fix = sample;
    });
    take_all<types::ImuSample>(*imu_reader, [&](const types::ImuSample& sample) {
      imu.add(sample.header().sequence_number());
      note("imu", sample.header().sequence_number(), sample.dtheta_b_rad()[0], sample.dv_b_m_per_s()[2]);
      types::NavSolution nav = solve(fix, sample);
      // With a handle it returns a code in 2.x too.
      if (nav_writer->write(&nav, HANDLE_NIL) == RETCODE_OK) ++published;
    });
    take_all<types::TruthState>(*truth_reader, [&](const types::TruthState& sample) {
      truth.add(sample.header().sequence_number());
      note("truth", sample.header().sequence_number(), sample.latitude_rad(), sample.dv_v_m_per_s()[2]);
    });
  }
  nav_writer->wait_for_acknowledgments({2, 0});
  if (values != nullptr) std::fclose(values);
  const bool whole_truth = truth.print("inslab/truth");
  const bool whole_imu = imu.print("inslab/imu/0");
  const bool whole_gnss = gnss.print("inslab/gnss/0");
  std::printf("inslab/nav: %" PRIu64 " solutions published\n", published);
  return whole_truth && whole_imu && whole_gnss ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  // 3.x looks for XML profiles under a new name; the simulator's manual says the old one.
  const char* profiles = std::getenv("FASTRTPS_DEFAULT_PROFILES_FILE");
  if (profiles != nullptr) setenv("FASTDDS_DEFAULT_PROFILES_FILE", profiles, 0);
  try {
    const Options options = parse(argc, argv);
    return options.blocks ? navigate_in_blocks(options) : navigate(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fastdds_nav_client: %s\n", error.what());
    return 2;
  }
}
