#include "inslab/formats/tables/columns.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "inslab/data/catalog/wire_type.hpp"
#include "inslab/data/samples/imu_truth.hpp"
#include "inslab/data/samples/service_status.hpp"
#include "inslab/data/samples/truth_state.hpp"
#include "inslab/data/wire/cdr.hpp"
#include "inslab/formats/log/log_types.hpp"
#include "tests/unit/formats/recordings/random_sample.hpp"

namespace inslab::tables {
namespace columns_test {

const Column& column(const std::vector<Column>& columns, const std::string& name) {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  if (found == columns.end()) throw std::out_of_range(name);
  return *found;
}

template <class T>
const Cell& cell(const T& value, const std::string& name, Row& row) {
  const std::vector<Column> columns = columns_of<T>();
  fill_row(value, row);
  return row.at(static_cast<std::size_t>(&column(columns, name) - columns.data()));
}

TEST(Columns, NestedFieldsAreJoinedWithADot) {
  const std::vector<Column> columns = columns_of<TruthState>();
  EXPECT_EQ(columns.front().name, "header.run_id");
  EXPECT_EQ(column(columns, "header.sim_time_ns").kind, ColumnKind::Int64);
  EXPECT_EQ(column(columns, "header.sequence_number").kind, ColumnKind::UInt64);
  EXPECT_EQ(column(columns, "v_n_m_per_s.z").kind, ColumnKind::Double);
  EXPECT_EQ(column(columns, "rate_jump").kind, ColumnKind::Bool);
  EXPECT_EQ(column(columns_of<ImuTruth>(), "gyro_error_rad.noise.y").kind, ColumnKind::Double);
}

TEST(Columns, UnitsComeFromTheSuffixOfTheNameOrOfWhatEnclosesIt) {
  EXPECT_EQ(unit_of("v_n_m_per_s.x"), "m/s");
  EXPECT_EQ(unit_of("f_v_m_per_s2.z"), "m/s^2");
  EXPECT_EQ(unit_of("omega_iv_v_rad_per_s.x"), "rad/s");
  EXPECT_EQ(unit_of("gyro_error_rad.g_sensitivity.y"), "rad");
  EXPECT_EQ(unit_of("header.gps_time_of_week_ns"), "ns");
  EXPECT_EQ(unit_of("temperature_deg_c"), "degC");
  EXPECT_EQ(unit_of("gyro.arw_deg_per_sqrt_h.x"), "deg/sqrt(h)");
  EXPECT_EQ(unit_of("accel.vrw_m_per_s_per_sqrt_h.x"), "m/s/sqrt(h)");
  EXPECT_EQ(unit_of("latency_p50_s"), "s");
  EXPECT_EQ(unit_of("height_m"), "m");
  EXPECT_EQ(unit_of("q_nv.w"), "1");
  EXPECT_EQ(unit_of("hdop"), "1");
}

TEST(Columns, EveryTypeHasAsManyCellsAsColumnsAndDistinctNames) {
  for (const log::LogType& type : log::log_types()) {
    std::vector<std::string> names;
    for (const Column& c : type.columns) names.push_back(c.name);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::unique(names.begin(), names.end()), names.end()) << type.name;
  }
  test::RandomFields random(1);
  Row row;
  for (int i = 0; i < 20; ++i) {
    fill_row(random.make<ServiceStatus>(), row);
    EXPECT_EQ(row.size(), columns_of<ServiceStatus>().size());
    fill_row(random.make<ImuTruth>(), row);
    EXPECT_EQ(row.size(), columns_of<ImuTruth>().size());
  }
}

TEST(Columns, ListElementsBeyondTheCountAreEmpty) {
  ServiceStatus status;
  status.streams.resize(2);
  status.streams[1].samples = 7;
  Row row;
  EXPECT_EQ(std::get<std::uint32_t>(cell(status, "streams.count", row)), 2u);
  EXPECT_EQ(std::get<std::uint64_t>(cell(status, "streams.1.samples", row)), 7u);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(cell(status, "streams.2.samples", row)));
}

TEST(Columns, QuaternionsAreScalarFirst) {
  TruthState truth;
  truth.q_nv = Quaternion(0.1, 0.2, 0.3, 0.4);
  Row row;
  EXPECT_EQ(std::get<double>(cell(truth, "q_nv.w", row)), 0.1);
  EXPECT_EQ(std::get<double>(cell(truth, "q_nv.z", row)), 0.4);
}

TEST(Columns, RunIdIsHexadecimal) {
  RunId run;
  run.bytes[0] = 0xab;
  run.bytes[15] = 0x01;
  EXPECT_EQ(to_hex(run), "ab000000000000000000000000000001");
}

TEST(LogTypes, ReadTheStampOutOfAPayload) {
  TruthState truth;
  truth.header.run_id.bytes[3] = 9;
  truth.header.sequence_number = 12;
  truth.header.sim_time_ns = 34;
  std::vector<std::uint8_t> payload;
  wire::encode(truth, payload);
  const log::LogType* type = log::find_log_type("inslab::v5::TruthState");
  ASSERT_NE(type, nullptr);
  log::SampleStamp stamp;
  ASSERT_TRUE(type->stamp(payload.data(), payload.size(), stamp));
  EXPECT_EQ(stamp.run_id, truth.header.run_id);
  EXPECT_EQ(stamp.sequence_number, 12u);
  EXPECT_EQ(stamp.sim_time_ns, 34);
  EXPECT_FALSE(type->stamp(payload.data(), payload.size() / 2, stamp));
}

TEST(LogTypes, KnowEveryTopicTypeAndNoOther) {
  EXPECT_EQ(log::log_types().size(), 28u);
  EXPECT_NE(log::find_log_type("inslab::v5::ServiceStatus"), nullptr);
  EXPECT_EQ(log::find_log_type("inslab::v5::Nothing"), nullptr);
  EXPECT_EQ(log::find_log_type("inslab::v0::ServiceStatus"), nullptr);
}

}  // namespace columns_test
}  // namespace inslab::tables
