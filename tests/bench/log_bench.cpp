// What a message costs in the log, and how small zstd makes it: the measure behind McapWriter::kFastLevel.
//
// One step is a TruthState, an ImuSample and an ImuTruth (about 350 bytes each) with noise in every low bit, as a
// simulated IMU with white noise and Gauss-Markov bias makes them. Counters: messages per second, and the size of the
// file as a part of the payload's.

#include <benchmark/benchmark.h>

#include <filesystem>
#include <random>
#include <string>

#include "inslab/data/catalog/wire_type.hpp"
#include "inslab/data/wire/cdr.hpp"
#include "inslab/data/wire/idl_text.hpp"
#include "inslab/formats/mcap/mcap_writer.hpp"

namespace {

using namespace inslab;

constexpr int kSteps = 4096;

struct Step {
  TruthState truth;
  ImuSample imu;
  ImuTruth imu_truth;
};

StreamHeader header_of(int k) {
  StreamHeader header;
  header.run_id.bytes.fill(0x5a);
  header.sequence_number = static_cast<std::uint64_t>(k);
  header.sim_time_ns = std::int64_t{5'000'000} * k;
  header.gps_week = 2400;
  header.gps_time_of_week_ns = 345'600'000'000'000 + header.sim_time_ns;
  header.publish_realtime_ns = 1'790'000'000'000'000'000 + header.sim_time_ns + (k * 7919) % 90001;
  header.publish_monotonic_ns = 90'000'000'000'000 + header.sim_time_ns + (k * 7919) % 90001;
  return header;
}

std::vector<Step> make_steps() {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  const auto noise = [&](double sigma) {
    return Vector3(sigma * normal(engine), sigma * normal(engine), sigma * normal(engine));
  };
  std::vector<Step> steps(kSteps);
  for (int k = 0; k < kSteps; ++k) {
    const double t = 0.005 * k;
    TruthState& truth = steps[k].truth;
    truth.header = header_of(k);
    truth.latitude_rad = 0.53 + 2e-6 * std::sin(0.1 * t);
    truth.longitude_rad = 1.99 + 2e-6 * std::cos(0.1 * t);
    truth.height_m = 20.0 + std::sin(0.2 * t);
    truth.v_n = Vector3(10.0 * std::cos(0.1 * t), 10.0 * std::sin(0.1 * t), 0.2 * std::cos(0.2 * t));
    truth.q_nv = Quaternion(std::cos(0.05 * t), 0.01, 0.02, std::sin(0.05 * t)).normalized();
    truth.omega_iv_v = Vector3(1e-5, 2e-5, 0.1 + 1e-5 * std::sin(t));
    truth.f_v = Vector3(0.1 * std::sin(t), 1.0, -9.79 + 0.01 * std::cos(t));
    truth.dtheta_v = 0.005 * truth.omega_iv_v;
    truth.dv_v = 0.005 * truth.f_v;
    truth.interval_ns = 5'000'000;

    ImuTruth& imu_truth = steps[k].imu_truth;
    imu_truth.header = truth.header;
    imu_truth.dtheta_b = truth.dtheta_v + noise(1e-12);
    imu_truth.dv_b = truth.dv_v + noise(1e-12);
    imu_truth.interval_ns = 5'000'000;
    imu_truth.latitude_rad = truth.latitude_rad;
    imu_truth.longitude_rad = truth.longitude_rad;
    imu_truth.height_m = truth.height_m;
    imu_truth.v_n = truth.v_n;
    imu_truth.q_nb = truth.q_nv;
    imu_truth.gyro_error = {noise(1e-8), noise(1e-9), noise(1e-9), noise(1e-10), noise(1e-7), noise(1e-6), noise(1e-9)};
    imu_truth.accel_error = {noise(1e-6), noise(1e-7), noise(1e-7), noise(1e-8), noise(1e-4), noise(1e-4), noise(1e-7)};

    ImuSample& imu = steps[k].imu;
    imu.header = truth.header;
    imu.dtheta_b = imu_truth.dtheta_b + imu_truth.gyro_error.sum();
    imu.dv_b = imu_truth.dv_b + imu_truth.accel_error.sum();
    imu.interval_ns = 5'000'000;
    imu.mean_omega_ib_b = imu.dtheta_b / 0.005;
    imu.mean_f_b = imu.dv_b / 0.005;
  }
  return steps;
}

template <class T>
std::uint16_t add(mcap::McapWriter& writer, const std::string& topic) {
  const auto schema =
      writer.add_schema(catalog::WireType<T>::name, "omgidl", wire::self_contained_idl(catalog::WireType<T>::idl_file));
  return writer.add_channel(schema, topic, "cdr");
}

template <class T>
std::size_t put(mcap::McapWriter& writer, std::uint16_t channel, const T& sample) {
  const auto time = static_cast<std::uint64_t>(sample.header.sim_time_ns);
  const std::size_t size = wire::encoded_size(sample);
  wire::encode_to(sample,
                  writer.reserve(channel, static_cast<std::uint32_t>(sample.header.sequence_number), time, time, size));
  return size;
}

std::string log_path() { return (std::filesystem::temp_directory_path() / "inslab_log_bench.mcap").string(); }

void BM_LogWrite(benchmark::State& state) {
  const std::vector<Step> steps = make_steps();
  mcap::McapWriter::Options options;
  options.compression_level = static_cast<int>(state.range(0));
  options.chunk_bytes = static_cast<std::size_t>(state.range(1)) << 10;
  double payload = 0.0;
  mcap::McapWriter writer(log_path(), options);
  const std::uint16_t truth = add<TruthState>(writer, "inslab/truth");
  const std::uint16_t imu = add<ImuSample>(writer, "inslab/imu/0");
  const std::uint16_t imu_truth = add<ImuTruth>(writer, "inslab/imu_truth/0");
  for (auto _ : state) {
    for (const Step& step : steps) {
      payload += static_cast<double>(put(writer, truth, step.truth) + put(writer, imu, step.imu) +
                                     put(writer, imu_truth, step.imu_truth));
    }
  }
  writer.flush();
  const double messages = 3.0 * kSteps * static_cast<double>(state.iterations());
  state.counters["messages_per_s"] = benchmark::Counter(messages, benchmark::Counter::kIsRate);
  state.counters["bytes_per_message"] = payload / messages;
  state.counters["file_over_payload"] = static_cast<double>(writer.file_size()) / payload;
  writer.close();
  std::filesystem::remove(log_path());
}
BENCHMARK(BM_LogWrite)
    ->ArgNames({"zstd_level", "chunk_kib"})
    ->ArgsProduct({{-7, -5, -3, -1, 1, 2, 3}, {1024}})
    ->ArgsProduct({{-1}, {256, 4096}})
    ->MinTime(1.0)
    ->Unit(benchmark::kMillisecond);

}  // namespace
