#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/bench/process.hpp"

/// A short run of the real services, one process each, and what their log says of its latencies.
namespace inslab::bench {

/// The app under test. In lockstep it paces the run.
enum class NavApp { None, Reference, ClientOnBlocks, ClientOnSingles };

struct ChainSettings {
  double rate_hz = 200.0;  ///< of truth and IMU
  double duration_s = 5.0;
  std::string transport = "udp";
  std::uint32_t domain = 0;
  std::string folder;     ///< for the scenario and the log
  bool copying = false;   ///< injector and emulator copy bytes instead of modelling sensors
  bool lockstep = false;  ///< as fast as the consumers follow, instead of in real time
  NavApp nav_app = NavApp::None;
};

struct ChainBlock {
  std::vector<double> one_hop_s;   ///< publish time of an ImuSample less that of the TruthState of its instant
  std::vector<double> solution_s;  ///< receipt of a NavSolution by the logger less publish time of its ImuSample
  std::vector<double> two_hops_s;  ///< receipt of an ImuSample by the logger less publish time of that TruthState
  /// Median from the publish time of truth to its receipt, in the callback, as each of its readers reports it.
  std::map<std::string, double> truth_receipt_p50_s;
  std::map<std::string, ProcessEnd> services;
  double wall_s = 0.0;  ///< from the first to the last truth sample
};

/// The services of the demo scenario, without its swaps, one process each, from the constructor on; ended with this.
class ChainServices {
 public:
  explicit ChainServices(const ChainSettings& settings);
  const std::vector<std::unique_ptr<Process>>& processes() const { return processes_; }

 private:
  std::vector<std::unique_ptr<Process>> processes_;
  std::unique_ptr<Process> nav_app_;
};

/// Runs the services of the demo scenario, without its swaps, for `duration_s`; the latencies leave out the first half
/// second. Throws std::runtime_error when a service fails, which it does when a sample is lost.
ChainBlock run_chain(const ChainSettings& settings);

}  // namespace inslab::bench
