#include "inslab/data/state/state_stream.hpp"

#include <gtest/gtest.h>

#include "inslab/data/samples/imu_sample.hpp"

namespace inslab::state {
namespace state_stream_test {

struct Inner {
  double x = 0.0;
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.x);
  }
};

struct Everything {
  std::uint64_t number = 0;
  bool flag = false;
  Vector3 vector = Vector3::Zero();
  std::optional<Inner> maybe;
  std::array<Inner, 2> pair;
  std::vector<Inner> list;
  std::vector<double> plain;
  std::variant<double, ImuSample> either;
  ImuSample sample;

  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.number, self.flag, self.vector, self.maybe, self.pair, self.list, self.plain, self.either, self.sample);
  }
};

std::vector<std::uint8_t> written(const Everything& value) {
  std::vector<std::uint8_t> bytes;
  StateWriter writer(bytes);
  writer(value);
  return bytes;
}

Everything example() {
  Everything value;
  value.number = 42;
  value.flag = true;
  value.vector = {1.0, -0.0, 3.0};
  value.maybe = Inner{0.1};
  value.pair[1].x = 0.2;
  value.list = {{1.0}, {2.0}, {3.0}};
  value.plain = {4.0, 5.0};
  value.sample.header.sequence_number = 7;
  value.sample.dv_b.y() = 0.3;
  value.either = value.sample;
  return value;
}

TEST(StateStream, GivesBackWhatWasWritten) {
  const auto bytes = written(example());
  Everything back;
  StateReader reader(bytes.data(), bytes.size());
  reader(back);
  reader.expect_end();
  EXPECT_EQ(written(back), bytes);
  EXPECT_EQ(back.list.at(2).x, 3.0);
  EXPECT_EQ(std::get<ImuSample>(back.either).dv_b.y(), 0.3);
}

TEST(StateStream, RefusesBytesThatEndEarlyWhereverTheyEnd) {
  const auto bytes = written(example());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    Everything back;
    StateReader reader(bytes.data(), size);
    EXPECT_THROW(reader(back), StateError) << size;
  }
}

TEST(StateStream, RefusesBytesThatAreLeftOver) {
  auto bytes = written(example());
  bytes.push_back(0);
  Everything back;
  StateReader reader(bytes.data(), bytes.size());
  reader(back);
  EXPECT_THROW(reader.expect_end(), StateError);
}

}  // namespace state_stream_test
}  // namespace inslab::state
