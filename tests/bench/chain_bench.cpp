// What the chain adds to a bare hop of Fast DDS: truth to IMU (one hop), truth to the reader of the IMU (two hops), and
// beside them, in alternating blocks of the same run, a bare writer and a bare callback with the same type and
// settings: with one reader, and with three, as many as the truth has in the chain.
//
// Beside the whole chain runs one whose injector and emulator copy bytes: what the chain takes more its models take.
//
// The machine's own noise changes by a factor within minutes, so each block of the chain is divided by the bare block
// right before it, and the medians of these ratios are what to quote.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "inslab/bus/service/service.hpp"
#include "tests/bench/bare_hop.hpp"
#include "tests/bench/chain_block.hpp"
#include "tests/bench/swap_latency.hpp"

namespace {

using namespace inslab;

struct Options {
  std::vector<double> rates_hz{200.0, 1000.0};
  std::vector<std::string> transports{"udp", "shm"};
  double duration_s = 5.0;
  int repetitions = 5;
  std::uint32_t domain = 90;
  int swaps = 0;
  double lockstep_s = 0.0;
  bool solutions = false;
  int readers = 1;          // of a child process: those the bare writer waits for
  std::string body;         // of a child process: what it does
  std::string result_file;  // of a child process
};

/// The value that the share `q` of all does not exceed.
double quantile(std::vector<double> values, double q) {
  const auto rank = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

double median(const std::vector<double>& values) { return quantile(values, 0.5); }

/// One row of figures a block.
struct Rows {
  std::vector<double> bare_p50, bare_p99, fan_p50, fan_p99, one_over_fan, one_p50, one_p99, two_p50, two_p99,
      one_over_bare, two_over_bare, copy_p50, copy_p99, two_over_copy;
  std::map<std::string, std::vector<double>> truth_receipt_p50;
  std::map<std::string, std::vector<double>> cpu_percent;
  std::map<std::string, double> peak_rss_mb;

  void add(const std::vector<double>& bare, const std::vector<double>& fan, const bench::ChainBlock& copying,
           const bench::ChainBlock& chain, double duration_s) {
    copy_p50.push_back(quantile(copying.two_hops_s, 0.5));
    copy_p99.push_back(quantile(copying.two_hops_s, 0.99));
    fan_p50.push_back(quantile(fan, 0.5));
    fan_p99.push_back(quantile(fan, 0.99));
    bare_p50.push_back(quantile(bare, 0.5));
    bare_p99.push_back(quantile(bare, 0.99));
    one_p50.push_back(quantile(chain.one_hop_s, 0.5));
    one_p99.push_back(quantile(chain.one_hop_s, 0.99));
    two_p50.push_back(quantile(chain.two_hops_s, 0.5));
    two_p99.push_back(quantile(chain.two_hops_s, 0.99));
    one_over_bare.push_back(one_p50.back() / bare_p50.back());
    one_over_fan.push_back(one_p50.back() / fan_p50.back());
    two_over_bare.push_back(two_p50.back() / bare_p50.back());
    two_over_copy.push_back(two_p50.back() / copy_p50.back());
    for (const auto& [service, p50] : chain.truth_receipt_p50_s) truth_receipt_p50[service].push_back(p50);
    for (const auto& [service, end] : chain.services) {
      cpu_percent[service].push_back(100.0 * end.cpu_s / duration_s);
      peak_rss_mb[service] = std::max(peak_rss_mb[service], end.peak_rss_mb);
    }
  }
};

void print(double rate_hz, const std::string& transport, const Rows& rows) {
  const auto line = [](const char* what, const std::vector<double>& p50, const std::vector<double>& p99) {
    std::printf("  %-34s p50 %6.0f us   p99 %6.0f us", what, 1e6 * median(p50), 1e6 * median(p99));
  };
  std::printf("%.0f Hz, %s, medians of %zu blocks\n", rate_hz, transport.c_str(), rows.bare_p50.size());
  line("bare hop", rows.bare_p50, rows.bare_p99);
  std::printf("\n");
  line("bare hop to three readers", rows.fan_p50, rows.fan_p99);
  std::printf("\n");
  line("truth to IMU", rows.one_p50, rows.one_p99);
  std::printf("   p50 over bare %.2f (%.2f to %.2f), over three readers' %.2f\n", median(rows.one_over_bare),
              quantile(rows.one_over_bare, 0.0), quantile(rows.one_over_bare, 1.0), median(rows.one_over_fan));
  line("truth to the IMU's subscriber", rows.two_p50, rows.two_p99);
  std::printf("   p50 over bare %.2f (%.2f to %.2f)\n", median(rows.two_over_bare), quantile(rows.two_over_bare, 0.0),
              quantile(rows.two_over_bare, 1.0));
  line("the same, models that copy bytes", rows.copy_p50, rows.copy_p99);
  std::printf("   p50 of the chain over it %.2f (%.2f to %.2f)\n", median(rows.two_over_copy),
              quantile(rows.two_over_copy, 0.0), quantile(rows.two_over_copy, 1.0));
  for (const auto& [service, p50] : rows.truth_receipt_p50) {
    std::printf("  truth to %-25s p50 %6.0f us, in its callback\n", service.c_str(), 1e6 * median(p50));
  }
  for (const auto& [service, cpu] : rows.cpu_percent) {
    std::printf("  %-34s CPU %5.1f %% of a core, start and end included   RSS %.1f MB\n", service.c_str(), median(cpu),
                rows.peak_rss_mb.at(service));
  }
  std::fflush(stdout);
}

void measure(const Options& options, double rate_hz, const std::string& transport, const std::string& folder) {
  service::NetworkOptions network;
  network.domain = options.domain;
  network.transport = transport;
  const bench::BareHop hop{service::participant_options(network, "bench"), rate_hz, options.duration_s, 1};
  const bench::BareHop fan{hop.network, rate_hz, options.duration_s, 3};
  const bench::ChainSettings settings{rate_hz, options.duration_s, transport, options.domain, folder};
  bench::ChainSettings copying = settings;
  copying.copying = true;
  Rows rows;
  for (int i = 0; i < options.repetitions; ++i) {
    const std::vector<double> bare = bench::measure_bare_hop(hop, transport, folder);
    const std::vector<double> three = bench::measure_bare_hop(fan, transport, folder);
    const bench::ChainBlock copied = bench::run_chain(copying);
    rows.add(bare, three, copied, bench::run_chain(settings), options.duration_s);
  }
  print(rate_hz, transport, rows);
}

/// The reference navigation app live: from the publishing of an IMU sample to the receipt of its solution, two hops and
/// the filter between them.
void measure_solutions(const Options& options, const std::string& folder) {
  for (const double rate_hz : options.rates_hz) {
    bench::ChainSettings settings{rate_hz, options.duration_s, "udp", options.domain, folder};
    settings.nav_app = bench::NavApp::Reference;
    std::vector<double> p50, p99;
    for (int i = 0; i < options.repetitions; ++i) {
      const std::vector<double> waits = bench::run_chain(settings).solution_s;
      if (waits.empty()) throw std::runtime_error("the app aligned until the end: it needs more --seconds");
      p50.push_back(quantile(waits, 0.5));
      p99.push_back(quantile(waits, 0.99));
    }
    std::printf("IMU sample to receipt of its NavSolution, %.0f Hz, medians of %d: p50 %.3f ms, p99 %.3f ms\n", rate_hz,
                options.repetitions, 1e3 * median(p50), 1e3 * median(p99));
  }
}

/// Lockstep: sim seconds a second of the whole set, of the set whose models copy bytes, and with the reference
/// navigation app or the example client as the app under test.
void measure_lockstep(const Options& options, const std::string& folder) {
  bench::ChainSettings settings{200.0, options.lockstep_s, "udp", options.domain, folder};
  settings.lockstep = true;
  std::vector<double> chain, copying, reference, on_singles, on_blocks, over_copying;
  for (int i = 0; i < options.repetitions; ++i) {
    const auto speed = [&](bool copies, bench::NavApp app) {
      settings.copying = copies;
      settings.nav_app = app;
      return options.lockstep_s / bench::run_chain(settings).wall_s;
    };
    copying.push_back(speed(true, bench::NavApp::None));
    chain.push_back(speed(false, bench::NavApp::None));
    over_copying.push_back(chain.back() / copying.back());
    reference.push_back(speed(false, bench::NavApp::Reference));
    on_blocks.push_back(speed(false, bench::NavApp::ClientOnBlocks));
    on_singles.push_back(speed(false, bench::NavApp::ClientOnSingles));
  }
  std::printf("lockstep, %.0f s of sim time at 200 Hz, medians of %d\n", options.lockstep_s, options.repetitions);
  std::printf("  models that copy bytes          %6.0f x real time\n", median(copying));
  std::printf("  the whole set                   %6.0f x real time   %.2f of the copying one (%.2f to %.2f)\n",
              median(chain), median(over_copying), quantile(over_copying, 0.0), quantile(over_copying, 1.0));
  std::printf("  and the reference nav app       %6.0f x real time\n", median(reference));
  std::printf("  and a nav app that reads blocks %6.0f x real time\n", median(on_blocks));
  std::printf("  and a nav app on single samples %6.0f x real time\n", median(on_singles));
}

void measure_swaps(const Options& options, const std::string& folder) {
  const std::vector<double> waits =
      bench::measure_swap_latency({200.0, 0.05 * options.swaps + 5.0, "udp", options.domain, folder}, options.swaps);
  std::printf(
      "swap command to receipt of the first sample under it, 200 Hz, %zu swaps: p50 %.3f ms, p99 %.3f ms, max "
      "%.3f ms\n",
      waits.size(), 1e3 * median(waits), 1e3 * quantile(waits, 0.99), 1e3 * quantile(waits, 1.0));
}

int run_body(const Options& options) {
  service::NetworkOptions network;
  network.domain = options.domain;
  network.transport = options.transports.front();
  const bench::BareHop hop{service::participant_options(network, options.body), options.rates_hz.front(),
                           options.duration_s, options.readers};
  return options.body == "bare-writer" ? bench::write_bare_hop(hop) : bench::read_bare_hop(hop, options.result_file);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Latency of the chain beside a bare hop of Fast DDS", "bench_chain");
  app.add_option("--rate", options.rates_hz, "Hz, of truth and IMU")->capture_default_str();
  app.add_option("--transport", options.transports, "udp, shm")
      ->check(CLI::IsMember({"udp", "shm"}))
      ->capture_default_str();
  app.add_option("--seconds", options.duration_s, "length of a block")
      ->check(CLI::Range(1.0, 60.0))
      ->capture_default_str();
  app.add_option("--repetitions", options.repetitions, "blocks of each kind")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--domain", options.domain, "DDS domain")->capture_default_str();
  app.add_option("--swaps", options.swaps, "instead: how long this many swaps take to show")
      ->check(CLI::Range(1, 100'000));
  app.add_option("--lockstep", options.lockstep_s, "instead: how fast lockstep is over this much sim time, s")
      ->check(CLI::Range(10.0, 1e5));
  app.add_flag("--solutions", options.solutions, "instead: how long the reference navigation app takes, live");
  app.add_option("--body", options.body, "what a process of the bench does itself")->group("");
  app.add_option("--readers", options.readers)->group("");
  app.add_option("--result", options.result_file)->group("");
  CLI11_PARSE(app, argc, argv);
  try {
    if (!options.body.empty()) return run_body(options);
    const auto folder = std::filesystem::temp_directory_path() / ("inslab_bench_chain_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    if (options.swaps > 0) measure_swaps(options, folder.string());
    if (options.lockstep_s > 0.0) measure_lockstep(options, folder.string());
    if (options.solutions) measure_solutions(options, folder.string());
    if (options.swaps > 0 || options.lockstep_s > 0.0 || options.solutions) options.transports.clear();
    for (const std::string& transport : options.transports) {
      for (const double rate_hz : options.rates_hz) measure(options, rate_hz, transport, folder.string());
    }
    std::filesystem::remove_all(folder);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_chain: %s\n", error.what());
    return 1;
  }
}
