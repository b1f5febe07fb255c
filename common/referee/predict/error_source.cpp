#include "inslab/referee/predict/error_source.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "inslab/foundation/units/units.hpp"

namespace inslab::predict {
namespace {

struct Unit {
  const char* name;
  double si;
};
struct Kind {
  const char* name;
  SourceKind kind;
  const char* axes;
  std::vector<Unit> units;
};

const std::array<Kind, 5>& kinds() {
  using namespace units;
  static const std::array<Kind, 5> list{
      {{"position", SourceKind::Position, "ned", {{"m", 1.0}, {"km", 1000.0}}},
       {"velocity", SourceKind::Velocity, "ned", {{"m/s", 1.0}, {"km/h", 1.0 / 3.6}}},
       {"phi", SourceKind::Phi, "ned", {{"arcsec", kArcsec}, {"deg", kDeg}, {"mrad", 1e-3}, {"rad", 1.0}}},
       {"accel_bias",
        SourceKind::AccelBias,
        "nedxyz",
        {{"mGal", kMGal}, {"ug", 1e-6 * kG}, {"mg", 1e-3 * kG}, {"m/s^2", 1.0}}},
       {"gyro_bias", SourceKind::GyroBias, "nedxyz", {{"deg/h", kDegPerH}, {"deg/s", kDegPerS}, {"rad/s", 1.0}}}}};
  return list;
}

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw std::invalid_argument("source '" + text + "': " + why);
}

std::string kind_names() {
  std::string list;
  for (const Kind& kind : kinds()) list += (list.empty() ? "" : ", ") + std::string(kind.name);
  return list;
}

double value_of(const std::string& text, const std::string& given, const Kind& kind) {
  char* end = nullptr;
  const double number = std::strtod(given.c_str(), &end);
  if (end == given.c_str() || !std::isfinite(number)) refuse(text, "has no number after =");
  while (*end == ' ') ++end;
  std::string list;
  for (const Unit& unit : kind.units) {
    if (unit.name == std::string(end)) return number * unit.si;
    list += (list.empty() ? "" : ", ") + std::string(unit.name);
  }
  refuse(text, "has the unit '" + std::string(end) + "'; expected one of " + list);
}

}  // namespace

ErrorSource error_source(const std::string& text) {
  const std::size_t equals = text.find('='), before_axis = text.rfind('_', equals);
  if (equals == std::string::npos || before_axis == std::string::npos || before_axis + 2 != equals) {
    refuse(text, "expected NAME_AXIS=VALUE UNIT, such as gyro_bias_e=0.01deg/h");
  }
  const std::string name = text.substr(0, before_axis);
  for (const Kind& kind : kinds()) {
    if (name != kind.name) continue;
    const std::size_t axis = std::string(kind.axes).find(text[before_axis + 1]);
    if (axis == std::string::npos) refuse(text, "has an axis that is none of " + std::string(kind.axes));
    return {text, kind.kind, static_cast<int>(axis % 3), axis >= 3, value_of(text, text.substr(equals + 1), kind)};
  }
  refuse(text, "is of none of " + kind_names());
}

ConstantErrors constant_errors(const ErrorSource& source, const nav::Matrix3& C_nb) {
  ConstantErrors errors;
  nav::Vector3 vector = source.value * nav::Vector3::Unit(source.axis);
  if (source.in_body) vector = C_nb * vector;
  switch (source.kind) {
    case SourceKind::Position:
      errors.position_n = vector;
      break;
    case SourceKind::Velocity:
      errors.velocity_n = vector;
      break;
    case SourceKind::Phi:
      errors.phi_n = vector;
      break;
    case SourceKind::AccelBias:
      errors.accel_n = vector;
      break;
    case SourceKind::GyroBias:
      errors.gyro_n = vector;
      break;
  }
  return errors;
}

}  // namespace inslab::predict
