#include "inslab/formats/recordings/recorded_errors_file.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/data/samples/imu_sample.hpp"
#include "inslab/formats/log/log_channel.hpp"
#include "inslab/formats/log/log_topic.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/input_limits.hpp"
#include "inslab/foundation/files/number_line.hpp"

namespace inslab::recordings {
namespace {

constexpr const char* kRecord = "recorded_errors";
constexpr const char* kRate = "rate_hz";

/// A rate as digits that give the same double again.
std::string digits_of(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

ImuSample sample_of(const RecordedErrors::Increments& errors, std::uint64_t k, const time::Rate& rate) {
  ImuSample sample;
  const time::Nanoseconds end = rate.at(k + 1);
  sample.header.sequence_number = k;
  sample.header.sim_time_ns = end.count();
  sample.available_sim_time_ns = end.count();
  sample.interval_ns = (end - rate.at(k)).count();
  sample.dtheta_b = {errors[0], errors[1], errors[2]};
  sample.dv_b = {errors[3], errors[4], errors[5]};
  const double interval_s = time::to_seconds(sample.interval_ns);
  sample.mean_omega_ib_b = sample.dtheta_b / interval_s;
  sample.mean_f_b = sample.dv_b / interval_s;
  return sample;
}

time::Rate rate_of(const std::string& path, const std::map<std::string, std::string>& notes) {
  const auto text = notes.find(kRate);
  const auto hz = text == notes.end() ? std::nullopt : files::number_from(text->second);
  if (!hz || !(*hz >= 1e-3 && *hz <= 1e6)) {
    throw files::ReadError(path + ": its record " + kRecord + " has no " + kRate + " from 0.001 to 1000000");
  }
  return time::Rate(*hz);
}

}  // namespace

void write_recorded_errors(const std::string& path, const RecordedErrors& errors,
                           const std::map<std::string, std::string>& notes) {
  mcap::McapWriter::Options options;
  options.kind = files::OutputFile::Kind::Result;
  mcap::McapWriter log(path, options);
  mcap::StringMap record(notes.begin(), notes.end());
  record[kRate] = digits_of(errors.rate.hz());
  log.metadata(kRecord, record);
  log::LogChannel<ImuSample> channel(log, catalog::stream_topic<ImuSample>(0));
  for (std::size_t k = 0; k < errors.intervals.size(); ++k) {
    const ImuSample sample = sample_of(errors.intervals[k], k, errors.rate);
    const auto at_ns = static_cast<std::uint64_t>(sample.header.sim_time_ns);
    channel.write(sample, static_cast<std::uint32_t>(k), at_ns, at_ns);
  }
  log.close();
}

RecordedErrorsFile read_recorded_errors(const std::string& path) {
  const mcap::McapReader log(path);
  const auto& records = log.metadata();
  const auto record = std::find_if(records.begin(), records.end(), [](const auto& one) { return one.name == kRecord; });
  if (record == records.end()) {
    throw files::ReadError(path +
                           ": does not say that it holds the errors of an IMU; expected what `inslab graft "
                           "extract` writes");
  }
  RecordedErrorsFile file;
  file.notes.insert(record->values.begin(), record->values.end());
  RecordedErrors& errors = file.errors;
  errors.rate = rate_of(path, file.notes);
  const std::uint64_t unreadable =
      log::for_each_sample<ImuSample>(log, catalog::stream_topic<ImuSample>(0), [&](const ImuSample& sample, auto) {
        const std::uint64_t k = errors.intervals.size();
        if (k == files::kMaxRowsInMemory) {
          throw files::ReadError(path + ": has more than " + std::to_string(files::kMaxRowsInMemory) + " samples");
        }
        if (sample.header.sim_time_ns != errors.rate.at(k + 1).count()) {
          throw files::ReadError(path + ": sample " + std::to_string(k + 1) + " ends at " +
                                 std::to_string(time::to_seconds(sample.header.sim_time_ns)) + " s; expected " +
                                 std::to_string(time::to_seconds(errors.rate.at(k + 1))) + " s: no gap at " +
                                 file.notes.at(kRate) + " Hz");
        }
        const Vector3& theta = sample.dtheta_b;
        const Vector3& v = sample.dv_b;
        if (!theta.allFinite() || !v.allFinite()) {
          throw files::ReadError(path + ": sample " + std::to_string(k + 1) + " is not finite");
        }
        errors.intervals.push_back({theta.x(), theta.y(), theta.z(), v.x(), v.y(), v.z()});
        return true;
      });
  if (unreadable > 0) throw files::ReadError(path + ": " + std::to_string(unreadable) + " samples cannot be read");
  if (errors.intervals.empty()) throw files::ReadError(path + ": has no sample");
  return file;
}

}  // namespace inslab::recordings
