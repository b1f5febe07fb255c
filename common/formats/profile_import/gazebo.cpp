#include <fmt/format.h>
#include <tinyxml2.h>

#include <cmath>
#include <cstring>

#include "inslab/formats/profile_import/conversion.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/input_limits.hpp"
#include "inslab/foundation/files/text_lines.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::profile_import {
namespace {

using Element = tinyxml2::XMLElement;

/// Every <sensor type="imu"> below `element`.
void collect_imus(const std::string& file, const Element& element, std::size_t level,
                  std::vector<const Element*>& imus) {
  if (level > files::kMaxImportLevels) refuse_depth(file + ": line " + std::to_string(element.GetLineNum()));
  for (const Element* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    const char* type = child->Attribute("type");
    const bool is_imu = std::strcmp(child->Name(), "sensor") == 0 && type != nullptr && std::strcmp(type, "imu") == 0;
    if (is_imu) imus.push_back(child);
    collect_imus(file, *child, level + 1, imus);
  }
}

std::string name_of(const Element& sensor) {
  const char* name = sensor.Attribute("name");
  return name == nullptr ? "" : name;
}

/// One quantity of the noise, on three axes.
struct Noise {
  Vector3 mean = Vector3::Zero();
  Vector3 stddev = Vector3::Zero();
  Vector3 bias_mean = Vector3::Zero();
  Vector3 bias_stddev = Vector3::Zero();
  Vector3 dynamic_bias_stddev = Vector3::Zero();
  Vector3 dynamic_bias_correlation_time = Vector3::Zero();
  Vector3 precision = Vector3::Zero();
};

class Gazebo {
 public:
  Gazebo(std::string file, const ImportOptions& options) : file_(std::move(file)), options_(options) {}

  ImportedProfile run() {
    load();
    const Element& sensor = chosen_sensor();
    const Element* imu = sensor.FirstChildElement("imu");
    if (imu == nullptr) fail(sensor, "has no <imu>; expected one with noise in it");
    rate_hz_ = update_rate(sensor);
    imported_.profile.source =
        "Imported from a Gazebo model (SDF), IMU " + text::cut(text::shown(name_of(sensor)), 100);
    imported_.lines.push_back(
        fmt::format("sensor '{}' at {:g} Hz; axes turned from forward-left-up: constants along y "
                    "and z change their sign",
                    name_of(sensor), rate_hz_));
    Triad gyro{"gyro", "rad/s", units::kDegPerH, units::kDegPerSqrtH, units::kArcsec};
    Triad accel{"accel", "m/s^2", units::kMGal, units::kMPerSPerSqrtH, 1.0};
    convert(noise_of(*imu, "angular_velocity", "rate"), gyro, imported_.profile.gyro,
            imported_.profile.gyro.arw_deg_per_sqrt_h, imported_.profile.gyro.bias_constant_deg_per_h,
            imported_.profile.gyro.bias_turn_on_sigma_deg_per_h, imported_.profile.gyro.bias_gm_sigma_deg_per_h,
            imported_.profile.gyro.quantization_arcsec);
    convert(noise_of(*imu, "linear_acceleration", "accel"), accel, imported_.profile.accel,
            imported_.profile.accel.vrw_m_per_s_per_sqrt_h, imported_.profile.accel.bias_constant_mgal,
            imported_.profile.accel.bias_turn_on_sigma_mgal, imported_.profile.accel.bias_gm_sigma_mgal,
            imported_.profile.accel.quantization_m_per_s);
    check_imported(file_, imported_.profile);
    return imported_;
  }

 private:
  /// A triad's units: of the file, and of the profile in SI.
  struct Triad {
    const char* name;
    const char* unit;
    double bias;
    double density;
    double count;
  };

  [[noreturn]] void fail(const Element& element, const std::string& what) const {
    throw files::ReadError(file_ + ": line " + std::to_string(element.GetLineNum()) + ": <" + element.Name() + "> " +
                           what);
  }

  void load() {
    const std::string text = import_text(file_);
    if (document_.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
      if (document_.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED) {
        refuse_depth(file_ + ": line " + std::to_string(document_.ErrorLineNum()));
      }
      throw files::ReadError(file_ + ": line " + std::to_string(document_.ErrorLineNum()) +
                             ": is no XML, or is broken there; expected an SDF file of Gazebo");
    }
  }

  const Element& chosen_sensor() const {
    std::vector<const Element*> imus;
    if (document_.RootElement() != nullptr) collect_imus(file_, *document_.RootElement(), 1, imus);
    if (imus.empty()) throw files::ReadError(file_ + ": has no <sensor type=\"imu\">");
    std::string names;
    for (const Element* imu : imus) {
      if (name_of(*imu) == options_.sensor) return *imu;
      names += (names.empty() ? "" : ", ") + name_of(*imu);
    }
    if (!options_.sensor.empty()) {
      throw files::ReadError(file_ + ": has no IMU '" + options_.sensor + "'; it has " + names);
    }
    if (imus.size() > 1) throw files::ReadError(file_ + ": has several IMUs (" + names + "); choose with --sensor");
    return *imus.front();
  }

  double number(const Element& element) const {
    const char* text = element.GetText();
    const auto value = files::number_from(files::trimmed(text == nullptr ? "" : text));
    if (!value || !std::isfinite(*value)) fail(element, "is not a finite number");
    return *value;
  }

  double update_rate(const Element& sensor) const {
    if (options_.rate_hz) return *options_.rate_hz;
    const Element* rate = sensor.FirstChildElement("update_rate");
    if (rate == nullptr) fail(sensor, "has no <update_rate>, which its noise is given at; give it with --rate");
    const double value = number(*rate);
    if (!(value > 0.0)) fail(*rate, "is not above 0, so the rate is the physics engine's; give it with --rate");
    return value;
  }

  /// SDF 1.5 and later: <angular_velocity><x><noise>; SDF 1.4: <noise><rate> for all axes.
  Noise noise_of(const Element& imu, const char* quantity, const char* old_name) const {
    Noise noise;
    if (const Element* triad = imu.FirstChildElement(quantity)) {
      constexpr const char* kAxes[] = {"x", "y", "z"};
      for (int i = 0; i < 3; ++i) {
        const Element* axis = triad->FirstChildElement(kAxes[i]);
        const Element* element = axis == nullptr ? nullptr : axis->FirstChildElement("noise");
        if (element == nullptr) continue;
        const char* type = element->Attribute("type");
        if (type != nullptr && std::strcmp(type, "none") == 0) continue;
        read(*element, i, noise);
      }
    } else if (const Element* old = imu.FirstChildElement("noise")) {
      if (const Element* element = old->FirstChildElement(old_name)) {
        for (int i = 0; i < 3; ++i) read(*element, i, noise);
      }
    }
    return noise;
  }

  void read(const Element& element, int axis, Noise& noise) const {
    const auto value = [&](const char* name, bool may_be_negative) {
      const Element* child = element.FirstChildElement(name);
      if (child == nullptr) return 0.0;
      const double found = number(*child);
      if (found < 0.0 && !may_be_negative) fail(*child, "is below 0");
      return found;
    };
    noise.mean[axis] = value("mean", true);
    noise.stddev[axis] = value("stddev", false);
    noise.bias_mean[axis] = value("bias_mean", true);
    noise.bias_stddev[axis] = value("bias_stddev", false);
    noise.dynamic_bias_stddev[axis] = value("dynamic_bias_stddev", false);
    noise.dynamic_bias_correlation_time[axis] = value("dynamic_bias_correlation_time", false);
    noise.precision[axis] = value("precision", false);
  }

  void say(const Triad& triad, const char* from, const Vector3& from_value, const char* to, const Vector3& to_value,
           const std::string& how) {
    if (from_value.isZero(0.0)) return;
    imported_.lines.push_back(conversion_line(fmt::format("{} <{}>", triad.name, from), from_value, triad.unit,
                                              fmt::format("{}.{}", triad.name, to), to_value, how));
  }

  template <class Errors>
  void convert(const Noise& noise, const Triad& triad, Errors& errors, Vector3& density, Vector3& constant,
               Vector3& turn_on, Vector3& gm_sigma, Vector3& count) {
    const bool is_gyro = std::is_same_v<Errors, GyroErrors>;
    const Vector3 flu_to_frd(1.0, -1.0, -1.0);
    density = noise.stddev / std::sqrt(rate_hz_) / triad.density;
    say(triad, "stddev", noise.stddev, is_gyro ? "arw_deg_per_sqrt_h" : "vrw_m_per_s_per_sqrt_h", density,
        fmt::format("a deviation at {:g} Hz: / sqrt(rate)", rate_hz_));
    constant = noise.mean.cwiseProduct(flu_to_frd) / triad.bias;
    say(triad, "mean", noise.mean, is_gyro ? "bias_constant_deg_per_h" : "bias_constant_mgal", constant, "a constant");
    turn_on = (noise.bias_mean.array().square() + noise.bias_stddev.array().square()).sqrt().matrix() / triad.bias;
    const Vector3 spread = turn_on * triad.bias;
    say(triad, "bias_mean, bias_stddev", spread, is_gyro ? "bias_turn_on_sigma_deg_per_h" : "bias_turn_on_sigma_mgal",
        turn_on,
        "Gazebo draws N(mean, stddev) and then its sign: no mean, and mean^2 + stddev^2 as variance; with a dynamic "
        "bias "
        "it fades there, here it stays");
    gm_sigma =
        noise.dynamic_bias_stddev.cwiseProduct((0.5 * noise.dynamic_bias_correlation_time).cwiseSqrt()) / triad.bias;
    for (int i = 0; i < 3; ++i) {
      if (gm_sigma[i] > 0.0) errors.bias_gm_correlation_time_s[i] = noise.dynamic_bias_correlation_time[i];
    }
    say(triad, "dynamic_bias_stddev", noise.dynamic_bias_stddev,
        is_gyro ? "bias_gm_sigma_deg_per_h" : "bias_gm_sigma_mgal", gm_sigma,
        "the density that drives it, a square root of a second: sigma = density sqrt(T/2)");
    if (!errors.bias_gm_correlation_time_s.isZero(0.0)) {
      imported_.lines.push_back(fmt::format(
          "{} <dynamic_bias_correlation_time> -> {}.bias_gm_correlation_time_s: the same", triad.name, triad.name));
    }
    count = noise.precision / rate_hz_ / triad.count;
    say(triad, "precision", noise.precision, is_gyro ? "quantization_arcsec" : "quantization_m_per_s", count,
        "a step of the rate over one interval; here the remainder is carried on");
  }

  std::string file_;
  ImportOptions options_;
  tinyxml2::XMLDocument document_;
  double rate_hz_ = 0.0;
  ImportedProfile imported_;
};

}  // namespace

ImportedProfile import_gazebo(const std::string& file, const ImportOptions& options) {
  return Gazebo(file, options).run();
}

}  // namespace inslab::profile_import
