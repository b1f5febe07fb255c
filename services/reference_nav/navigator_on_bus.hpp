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

namespace inslab::reference_nav {

/// The navigation app on the bus, as a flight computer would have it: reads one IMU and one receiver, never the truth,
/// and answers each IMU sample with a NavSolution on inslab/nav, in lockstep in blocks.
///
/// In real time a sample is answered at once, with the fixes that have come. In lockstep it waits for every fix that is
/// available before it, which the receiver's emulator tells by its credit for the truth; the solutions are then those
/// of an offline run, bit for bit.
class NavigatorOnBus {
 public:
  /// Throws config::Error when what the app is told is not good.
  NavigatorOnBus(app::Context& context, const scenario::ReferenceNav& app);

  /// Returns the exit code.
  int run();

 private:
  using Message = std::variant<app::Arrived<ImuSample>, app::Arrived<GnssFix>, SimStatus, ServiceStatus, Credit>;

  void handle(const Message& message);
  void handle(const app::Arrived<ImuSample>& arrived);
  void handle(const app::Arrived<GnssFix>& arrived);
  void handle(const SimStatus& status);
  void handle(const ServiceStatus& status);
  void handle(const Credit& credit);
  void navigate();
  void publish(const NavSolution& solution);
  void flush_block();
  std::string missing() const;
  bool finished() const;
  void stay_for_the_log();
  int end();

  app::Context& context_;
  scenario::ReferenceNav app_;
  time::Grid truth_grid_;
  Navigator navigator_;
  Refusals refusals_;  ///< of the alignment, that were said
  app::Mailbox<Message> mailbox_;
  app::RunFollower run_;
  app::StopGrace grace_;
  std::uint64_t next_imu_ = 0;             ///< samples before this one are answered
  std::uint64_t next_fix_ = 0;             ///< fixes before this one have come
  std::optional<std::uint64_t> imu_sent_;  ///< how many samples there were, when the injector has said it
  Block<NavSolution> gathered_;
  app::StreamMonitor sent_;
  app::StatusBoard board_;
  dds::Writer<NavSolution> solutions_;
  dds::Writer<Block<NavSolution>> blocks_;
  app::StreamInput<ImuSample> imu_;
  app::StreamInput<GnssFix> gnss_;
  app::SetReader<Credit> credits_;
  app::SetReader<ServiceStatus> service_status_;
  app::SetReader<SimStatus> sim_status_;
};

}  // namespace inslab::reference_nav
