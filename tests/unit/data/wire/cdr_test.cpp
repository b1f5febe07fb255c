#include "inslab/data/wire/cdr.hpp"

#include <gtest/gtest.h>

#include "inslab/data/catalog/wire_type.hpp"
#include "inslab/foundation/fields/limits.hpp"
#include "tests/unit/data/wire/earlier_version.hpp"
#include "tests/unit/formats/recordings/random_sample.hpp"
#include "tests/unit/foundation/fields/field_bits.hpp"
#include "tests/unit/foundation/fields/spoiled_fields.hpp"

namespace inslab::wire {
namespace cdr_test {

using Bytes = std::vector<std::uint8_t>;

template <class T>
Bytes encoded(const T& value) {
  Bytes bytes;
  encode(value, bytes);
  return bytes;
}

/// Writes a struct as a big-endian sender would: an encoder of its own, so that the decoder is not its own judge.
class BigEndianWriter {
 public:
  Bytes bytes{0x00, 0x00, 0x00, 0x00};

  template <class T>
  void operator()(const Field& field, const T& value) {
    if constexpr (std::is_same_v<T, RunId>) {
      bytes.insert(bytes.end(), value.bytes.begin(), value.bytes.end());
    } else if constexpr (std::is_same_v<T, bool>) {
      bytes.push_back(value ? 1 : 0);
    } else if constexpr (std::is_enum_v<T>) {
      number(static_cast<std::uint64_t>(value), 4);
    } else if constexpr (std::is_same_v<T, double>) {
      real(value);
    } else if constexpr (std::is_integral_v<T>) {
      number(static_cast<std::uint64_t>(value), sizeof(T));
    } else if constexpr (std::is_same_v<T, std::string>) {
      number(value.size() + 1, 4);
      bytes.insert(bytes.end(), value.c_str(), value.c_str() + value.size() + 1);
    } else if constexpr (std::is_same_v<T, Quaternion>) {
      for (const double x : {value.w(), value.x(), value.y(), value.z()}) real(x);
    } else if constexpr (is_list<T>) {
      number(value.size(), 4);
      for (const auto& element : value) (*this)(field, element);
    } else if constexpr (has_fields<T>) {
      T::fields(value, *this);
    } else {
      for (Eigen::Index i = 0; i < value.size(); ++i) real(value[i]);
    }
  }

 private:
  void number(std::uint64_t value, std::size_t width) {
    while ((bytes.size() - kEncapsulationSize) % width != 0) bytes.push_back(0);
    for (std::size_t i = width; i-- > 0;) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
  void real(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof(bits));
    number(bits, 8);
  }
};

template <class T>
class Cdr : public testing::Test {};

using AllTypes = catalog::EveryWireType<testing::Types>;
TYPED_TEST_SUITE(Cdr, AllTypes, );

TYPED_TEST(Cdr, GivesBackEveryBitOfRandomValuesInEitherByteOrder) {
  test::RandomFields random(1);
  for (int i = 0; i < 100; ++i) {
    const auto value = random.make<TypeParam>();
    const Bytes little = encoded(value);
    EXPECT_EQ(little.size(), encoded_size(value));
    TypeParam back;
    ASSERT_TRUE(decode(little.data(), little.size(), back));
    ASSERT_EQ(test::bits_of(back), test::bits_of(value));

    BigEndianWriter writer;
    TypeParam::fields(value, writer);
    TypeParam from_big;
    ASSERT_TRUE(decode(writer.bytes.data(), writer.bytes.size(), from_big));
    ASSERT_EQ(test::bits_of(from_big), test::bits_of(value));
  }
}

TYPED_TEST(Cdr, RefusesEveryTruncation) {
  test::RandomFields random(2);
  const auto value = random.make<TypeParam>();
  const Bytes bytes = encoded(value);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    if (test::is_whole_in_the_version_before(value, size)) continue;
    // A copy of exactly this size, so that a sanitizer sees any byte read beyond it.
    const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    TypeParam back;
    ASSERT_FALSE(decode(cut.data(), cut.size(), back)) << size << " of " << bytes.size();
  }
}

TEST(CdrOfAnEarlierVersion, LeavesWhatCameLaterAtItsDefault) {
  FaultProfile fault;
  fault.name = "before magnetometers";
  fault.outage = true;
  const Bytes bytes = encoded(fault);
  std::size_t earlier = 0;
  while (!test::is_whole_in_the_version_before(fault, earlier)) ASSERT_LT(++earlier, bytes.size());
  FaultProfile back;
  ASSERT_TRUE(decode(bytes.data(), earlier, back));
  EXPECT_EQ(back.name, fault.name);
  EXPECT_TRUE(back.outage);
  EXPECT_FALSE(back.magnetometer_silent);
}

/// Of a version before what was inserted since.
struct WriterOfEarlierFields {
  BigEndianWriter written;
  template <class Value>
  void operator()(const Field& field, const Value& part) {
    if (field.is_inserted) return;
    if constexpr (has_fields<Value>) {
      Value::fields(part, *this);
    } else {
      written(field, part);
    }
  }
};

TEST(CdrOfAnEarlierVersion, LeavesWhatWasInsertedAtItsDefault) {
  test::RandomFields random(7);
  auto truth = random.make<ImuTruth>();
  truth.discontinuity = true;
  WriterOfEarlierFields writer;
  ImuTruth::fields(truth, writer);
  ImuTruth back;
  ASSERT_TRUE(decode(writer.written.bytes.data(), writer.written.bytes.size(), back));
  EXPECT_EQ(back.gyro_error.limits, truth.gyro_error.limits);
  EXPECT_EQ(back.gyro_error.delay, Vector3::Zero());
  EXPECT_EQ(back.accel_error.bias, truth.accel_error.bias);
  EXPECT_EQ(back.accel_error.size_effect, Vector3::Zero());
  EXPECT_TRUE(back.discontinuity);
  EXPECT_EQ(back.revisions.fault, truth.revisions.fault);
}

TYPED_TEST(Cdr, SurvivesRandomBytes) {
  // Whatever is accepted can be sent on: encoding it again must work and be accepted.
  std::mt19937_64 engine(3);
  for (int i = 0; i < 2000; ++i) {
    Bytes bytes(engine() % 600);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(engine() % 4 == 0 ? engine() : 0);
    if (bytes.size() >= 2) {
      bytes[0] = 0;
      bytes[1] = static_cast<std::uint8_t>(engine() % 2);
    }
    TypeParam value;
    if (!decode(bytes.data(), bytes.size(), value)) continue;
    const Bytes again = encoded(value);
    TypeParam back;
    ASSERT_TRUE(decode(again.data(), again.size(), back));
  }
}

TYPED_TEST(Cdr, SurvivesASampleWithBytesChanged) {
  std::mt19937_64 engine(4);
  test::RandomFields random(5);
  for (int i = 0; i < 500; ++i) {
    Bytes bytes = encoded(random.make<TypeParam>());
    for (int change = 0; change < 4; ++change) {
      bytes[engine() % bytes.size()] = static_cast<std::uint8_t>(engine());
    }
    TypeParam value;
    if (decode(bytes.data(), bytes.size(), value)) (void)limit_violation(value);
  }
}

TYPED_TEST(Cdr, RefusesTextsEnumeratorsAndLengthsThatNobodyShouldSend) {
  for (const auto& spoiled : test::SpoiledFields<TypeParam>::refused()) {
    const Bytes bytes = encoded(spoiled.value);
    TypeParam back;
    EXPECT_FALSE(decode(bytes.data(), bytes.size(), back)) << spoiled.field;
  }
}

TYPED_TEST(Cdr, RefusesOtherRepresentations) {
  Bytes bytes = encoded(TypeParam{});
  for (int representation = 2; representation < 256; ++representation) {
    bytes[1] = static_cast<std::uint8_t>(representation);
    TypeParam back;
    ASSERT_FALSE(decode(bytes.data(), bytes.size(), back)) << representation;
  }
  bytes[1] = 1;
  bytes[0] = 1;
  TypeParam back;
  EXPECT_FALSE(decode(bytes.data(), bytes.size(), back));
}

/// Byte where `value` begins in the little-endian CDR of a struct of this shape: the last place it occurs.
std::size_t place_of(const Bytes& bytes, std::uint32_t value) {
  for (std::size_t at = bytes.size() - 4;; --at) {
    std::uint32_t here = 0;
    std::memcpy(&here, &bytes[at], 4);
    if (here == value) return at;
    if (at == 0) ADD_FAILURE() << "not found";
  }
}

template <class T>
bool accepts_with(const T& value, std::uint32_t old_number, std::uint32_t new_number) {
  Bytes bytes = encoded(value);
  std::memcpy(&bytes[place_of(bytes, old_number)], &new_number, 4);
  T back;
  return decode(bytes.data(), bytes.size(), back);
}

TEST(CdrBounds, RefuseAnEnumeratorOutsideItsEnum) {
  SimCommand command;
  command.request_id = ~std::uint64_t{0};
  command.kind = CommandKind::Step;
  constexpr auto kStep = static_cast<std::uint32_t>(CommandKind::Step);
  constexpr auto kEnd = static_cast<std::uint32_t>(EnumNames<CommandKind>::values.size());
  EXPECT_TRUE(accepts_with(command, kStep, kEnd - 1));
  EXPECT_FALSE(accepts_with(command, kStep, kEnd));
  EXPECT_FALSE(accepts_with(command, kStep, 0xffffffffU));
}

TEST(CdrBounds, RefuseATextOverItsBoundAndOneWithoutItsEnd) {
  SimStatus status;
  status.message = std::string(256, 'm');
  EXPECT_TRUE(accepts_with(status, 257, 257));
  EXPECT_FALSE(accepts_with(status, 257, 256)) << "the byte at its end is no NUL";
  status.message += 'm';
  EXPECT_FALSE(accepts_with(status, 258, 258));
  EXPECT_FALSE(accepts_with(status, 258, 0xffffffffU));
}

TEST(CdrBounds, TakeATextOfLengthZeroAsEmpty) {
  SimStatus status;
  Bytes bytes = encoded(status);
  // The last text is empty: its length is 1, for the NUL. Some senders write length 0 and no NUL.
  bytes.pop_back();
  const std::uint32_t none = 0;
  std::memcpy(&bytes[bytes.size() - 4], &none, 4);
  status.message = "old";
  ASSERT_TRUE(decode(bytes.data(), bytes.size(), status));
  EXPECT_EQ(status.message, "");
}

TEST(CdrBounds, RefuseAListOverItsBoundBeforeMakingRoomForIt) {
  VibrationProfile profile;
  profile.domain = VibrationDomain::Sensor;
  profile.angular.resize(16);
  EXPECT_TRUE(accepts_with(profile, 16, 16));
  profile.angular.resize(17);
  EXPECT_FALSE(accepts_with(profile, 17, 17));
  EXPECT_FALSE(accepts_with(profile, 17, 0xffffffffU));
}

}  // namespace cdr_test
}  // namespace inslab::wire
