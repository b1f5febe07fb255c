#pragma once

#include <variant>

#include "inslab/bus/service/service.hpp"
#include "inslab/bus/service/set_reader.hpp"
#include "inslab/bus/service/status_board.hpp"
#include "inslab/bus/service/stream_input.hpp"
#include "inslab/data/streams/run_follower.hpp"
#include "inslab/foundation/host/mailbox.hpp"
#include "inslab/foundation/host/stop_grace.hpp"
#include "inslab/models/navigation/navigator.hpp"
#include "inslab/models/navigation/refusals.hpp"
#include "inslab/services/reference_nav/aid_input.hpp"
#include "inslab/services/reference_nav/sources.hpp"

namespace inslab::reference_nav {

/// The navigation app on the bus, as a flight computer would have it: reads one IMU, one receiver and what other
/// sensors its scenario gives it, never the truth, and answers each IMU sample with a NavSolution on inslab/nav, in
/// lockstep in blocks.
///
/// In real time a sample is answered at once, with what has come. In lockstep it waits for every fix, and every sample
/// of another sensor, that is available before it, which their services tell by their credits for the truth; the
/// solutions are then those of an offline run, bit for bit.
class NavigatorOnBus {
 public:
  /// Throws json::Error when what the app is told is not good.
  NavigatorOnBus(service::Context& context, const scenario::ReferenceNav& app);

  /// Returns the exit code.
  int run();

 private:
  template <class Kind>
  using ArrivedOf = typename AidInput<Kind>::Arrived;
  using Aids = Applied<std::tuple, Mapped<AidInput, scenario::AidKinds>>;
  using Message =
      Applied<std::variant, Joined<Types<streams::Arrived<ImuSample>, streams::Arrived<GnssFix>>,
                                   Mapped<ArrivedOf, scenario::AidKinds>, Types<SimStatus, ServiceStatus, Credit>>>;

  void handle(const Message& message);
  void handle(const streams::Arrived<ImuSample>& arrived);
  void handle(const streams::Arrived<GnssFix>& arrived);
  template <class Arrived>
  void handle(const Arrived& arrived);
  void handle(const SimStatus& status);
  void handle(const ServiceStatus& status);
  void handle(const Credit& credit);
  template <class... Kind>
  Aids aids_of(Types<Kind...>);
  void navigate();
  void publish(const NavSolution& solution);
  void flush_block();
  std::string missing() const;
  bool finished() const;
  void stay_for_the_log();
  int end();

  service::Context& context_;
  scenario::ReferenceNav app_;
  Sources sources_;
  time::Grid truth_grid_;
  navigation::Navigator navigator_;
  navigation::Refusals refusals_;  ///< of the alignment, that were said
  host::Mailbox<Message> mailbox_;
  streams::RunFollower run_;
  host::StopGrace grace_;
  std::uint64_t next_imu_ = 0;             ///< samples before this one are answered
  std::uint64_t next_fix_ = 0;             ///< fixes before this one have come
  std::optional<std::uint64_t> imu_sent_;  ///< how many samples there were, when the injector has said it
  Block<NavSolution> gathered_;
  std::size_t burst_ = 0;  ///< solutions sent since this process last had done with all that had come
  streams::StreamMonitor sent_;
  service::StatusBoard board_;
  dds::Writer<NavSolution> solutions_;
  dds::Writer<Block<NavSolution>> blocks_;
  service::StreamInput<ImuSample> imu_;
  service::StreamInput<GnssFix> gnss_;
  Aids aids_;
  service::SetReader<Credit> credits_;
  service::SetReader<ServiceStatus> service_status_;
  service::SetReader<SimStatus> sim_status_;
};

}  // namespace inslab::reference_nav
