// Writes what the readers of this folder compare: a log that was closed and one whose writer was killed, and their
// exports. Samples of every type, with random values of the whole range of their fields.

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>

#include "inslab/formats/exports/log_export.hpp"
#include "inslab/formats/log/log_channel.hpp"
#include "inslab/formats/mcap/mcap_reader.hpp"
#include "tests/unit/formats/recordings/random_sample.hpp"

namespace {

using namespace inslab;

constexpr std::uint32_t kStreamSamples = 3000;
constexpr std::uint32_t kOtherSamples = 100;

template <class T>
void write_samples(mcap::McapWriter& log, const std::string& topic, std::uint32_t count, test::RandomFields& random) {
  log::LogChannel<T> channel(log, topic);
  for (std::uint32_t k = 0; k < count; ++k) channel.write(random.make<T>(), k, k * 5'000'000ULL, k * 5'000'000ULL + 1);
}

void write_all(mcap::McapWriter& log) {
  test::RandomFields random(20260101);
  log.metadata("run", {{"scenario", "random values"}, {"seed", "20260101"}});
  write_samples<TruthState>(log, "inslab/truth", kStreamSamples, random);
  write_samples<ImuSample>(log, "inslab/imu/0", kStreamSamples, random);
  write_samples<ImuTruth>(log, "inslab/imu_truth/0", kStreamSamples, random);
  write_samples<GnssFix>(log, "inslab/gnss/0", kStreamSamples, random);
  write_samples<NavSolution>(log, "inslab/nav", kStreamSamples, random);
  write_samples<ImuErrorProfile>(log, "inslab/journal/imu_error", kOtherSamples, random);
  write_samples<VibrationProfile>(log, "inslab/journal/vibration", kOtherSamples, random);
  write_samples<InstallationProfile>(log, "inslab/journal/installation", kOtherSamples, random);
  write_samples<GnssErrorProfile>(log, "inslab/journal/gnss_error", kOtherSamples, random);
  write_samples<FaultProfile>(log, "inslab/journal/fault", kOtherSamples, random);
  write_samples<ProfileAck>(log, "inslab/profile_ack", kOtherSamples, random);
  write_samples<Installation>(log, "inslab/installation", kOtherSamples, random);
  write_samples<SimCommand>(log, "inslab/sim/command", kOtherSamples, random);
  write_samples<SimStatus>(log, "inslab/sim/status", kOtherSamples, random);
  write_samples<TimeMark>(log, "inslab/time_mark", kOtherSamples, random);
  write_samples<ServiceStatus>(log, "inslab/service_status", kOtherSamples, random);
}

/// A child writes, flushes, goes on writing into the next chunk and kills itself.
void write_and_be_killed(const std::string& path) {
  const pid_t child = fork();
  if (child == 0) {
    mcap::McapWriter log(path);
    write_all(log);
    log.flush();
    test::RandomFields random(1);
    log::LogChannel<NavSolution>(log, "inslab/nav").write(random.make<NavSolution>(), 0, 0, 0);
    std::raise(SIGKILL);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child || !WIFSIGNALED(status)) {
    throw std::runtime_error("the writer was not killed");
  }
  if (mcap::McapReader(path).closed_properly()) throw std::runtime_error("the killed writer closed its log");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_logs FOLDER\n");
    return 2;
  }
  try {
    const std::string folder = argv[1];
    std::filesystem::create_directories(folder);
    {
      mcap::McapWriter log(folder + "/closed.mcap");
      write_all(log);
      log.close();
    }
    write_and_be_killed(folder + "/killed.mcap");
    for (const std::string name : {"closed", "killed"}) {
      exports::export_log(folder + "/" + name + ".mcap", exports::ExportFormat::Csv, folder + "/" + name + "_csv");
    }
    exports::export_log(folder + "/closed.mcap", exports::ExportFormat::Hdf5, folder + "/closed.h5");
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_logs: %s\n", error.what());
    return 1;
  }
}
