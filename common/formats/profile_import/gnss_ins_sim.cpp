#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>

#include "inslab/formats/profile_import/conversion.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/input_limits.hpp"
#include "inslab/foundation/files/text_lines.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::profile_import {
namespace {

/// Reads a dictionary of numbers and lists of three as Python or JSON writes it: np.array([...]) and products and
/// quotients with numbers, D2R and float("inf") are understood; a value of another key may be anything with closed
/// brackets.
class DictionaryReader {
 public:
  DictionaryReader(std::string file, std::string text) : file_(std::move(file)), text_(std::move(text)) {}

  std::map<std::string, Vector3> read() {
    at_ = begin_of_dictionary();
    std::map<std::string, Vector3> values;
    while (true) {
      skip_blanks();
      if (peek() == '}') return values;
      const std::string key = quoted();
      expect(':');
      const bool known = key.rfind("gyro_", 0) == 0 || key.rfind("accel_", 0) == 0;
      if (!known) {
        skip_value();
      } else if (!values.emplace(key, product()).second) {
        fail(text::quoted(key) + " is given twice");
      }
      skip_blanks();
      if (peek() == ',')
        ++at_;
      else if (peek() != '}')
        fail("expected ',' or '}'");
    }
  }

 private:
  std::string place() const {
    std::size_t line = 1, column = 1;
    for (std::size_t i = 0; i < at_ && i < text_.size(); ++i) {
      column = text_[i] == '\n' ? 1 : column + 1;
      if (text_[i] == '\n') ++line;
    }
    return file_ + ": line " + std::to_string(line) + ", column " + std::to_string(column);
  }
  [[noreturn]] void fail(const std::string& what) const { throw files::ReadError(place() + ": " + what); }

  /// The brace before the first key that begins with gyro_ or accel_.
  std::size_t begin_of_dictionary() {
    for (const char* key : {"'gyro_", "\"gyro_", "'accel_", "\"accel_"}) {
      const std::size_t found = text_.find(key);
      if (found == std::string::npos) continue;
      const std::size_t brace = text_.rfind('{', found);
      if (brace != std::string::npos) return brace + 1;
    }
    fail("has no dictionary with keys such as 'gyro_b'; expected an IMU error model of gnss-ins-sim");
  }

  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  void skip_blanks() {
    while (at_ < text_.size()) {
      if (text_[at_] == '#') {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      } else if (std::isspace(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '\\') {
        ++at_;
      } else {
        return;
      }
    }
  }

  void expect(char wanted) {
    skip_blanks();
    if (peek() != wanted) fail(std::string("expected '") + wanted + "'");
    ++at_;
  }

  std::string quoted() {
    skip_blanks();
    const char quote = peek();
    if (quote != '\'' && quote != '"') fail("expected a key in quotes");
    const std::size_t end = text_.find(quote, at_ + 1);
    if (end == std::string::npos) fail("expected the end of the quotes");
    std::string key = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return key;
  }

  void skip_value() {
    int depth = 0;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (depth == 0 && (c == ',' || c == '}')) return;
      if (c == '(' || c == '[' || c == '{') ++depth;
      if (c == ')' || c == ']' || c == '}') --depth;
    }
    fail("expected the end of the dictionary");
  }

  Vector3 product() {
    if (++level_ > files::kMaxImportLevels) refuse_depth(place());
    const Vector3 value = product_at_level();
    --level_;
    return value;
  }
  Vector3 product_at_level() {
    Vector3 value = factor();
    while (true) {
      skip_blanks();
      if (peek() == '*') {
        ++at_;
        value = value.cwiseProduct(factor());
      } else if (peek() == '/') {
        ++at_;
        value = value.cwiseQuotient(factor());
      } else {
        return value;
      }
    }
  }

  bool take_word(std::string_view word) {
    if (text_.compare(at_, word.size(), word) != 0) return false;
    at_ += word.size();
    return true;
  }

  /// A number stands for three of it.
  Vector3 factor() {
    skip_blanks();
    for (const char* name : {"np.array", "numpy.array"}) {
      if (!take_word(name)) continue;
      expect('(');
      const Vector3 value = product();
      expect(')');
      return value;
    }
    for (const char* name : {"float(\"inf\")", "float('inf')", "np.inf", "math.inf", "Infinity"}) {
      if (take_word(name)) return Vector3::Constant(std::numeric_limits<double>::infinity());
    }
    if (take_word("D2R")) return Vector3::Constant(units::kDeg);
    if (peek() == '[') return list();
    if (peek() == '(') {
      ++at_;
      const Vector3 value = product();
      expect(')');
      return value;
    }
    return Vector3::Constant(number());
  }

  Vector3 list() {
    expect('[');
    Vector3 value;
    for (int i = 0; i < 3; ++i) {
      if (i > 0) expect(',');
      const Vector3 element = product();
      value[i] = element[0];
    }
    skip_blanks();
    if (peek() != ']') fail("expected ']' after three numbers");
    ++at_;
    return value;
  }

  double number() {
    std::size_t end = at_;
    while (end < text_.size()) {
      const char c = text_[end];
      const bool exponent_sign =
          (c == '+' || c == '-') && end > at_ && (text_[end - 1] == 'e' || text_[end - 1] == 'E');
      const bool sign = (c == '+' || c == '-') && end == at_;
      if (std::isdigit(static_cast<unsigned char>(c)) == 0 && c != '.' && c != 'e' && c != 'E' && !exponent_sign &&
          !sign)
        break;
      ++end;
    }
    const auto value = files::number_from(std::string_view(text_).substr(at_, end - at_));
    if (!value) fail("expected a number, a list of three, or np.array of one");
    at_ = end;
    return *value;
  }

  std::string file_;
  std::string text_;
  std::size_t at_ = 0;
  std::size_t level_ = 0;  ///< brackets that are open around a number
};

constexpr std::string_view kKeys[] = {"gyro_b",  "gyro_arw",  "gyro_b_stability",  "gyro_b_corr",
                                      "accel_b", "accel_vrw", "accel_b_stability", "accel_b_corr"};

class Conversion {
 public:
  Conversion(const std::string& file, const ImportOptions& options) : file_(file), options_(options) {
    values_ = DictionaryReader(file, import_text(file)).read();
    for (const auto& [key, value] : values_) {
      if (std::find(std::begin(kKeys), std::end(kKeys), key) == std::end(kKeys)) {
        throw files::ReadError(file + ": " + text::quoted(key) + " is not a key of gnss-ins-sim");
      }
    }
  }

  ImportedProfile run() {
    imported_.profile.source = "Imported from an IMU error model of gnss-ins-sim";
    GyroErrors& gyro = imported_.profile.gyro;
    AccelErrors& accel = imported_.profile.accel;
    take("gyro_b", "deg/h", 1.0, "gyro.bias_constant_deg_per_h", gyro.bias_constant_deg_per_h, "the same");
    take("gyro_arw", "deg/sqrt(h)", 1.0, "gyro.arw_deg_per_sqrt_h", gyro.arw_deg_per_sqrt_h, "the same");
    take_bias("gyro", "deg/h", 1.0, 60.0, "gyro.bias_gm_sigma_deg_per_h", gyro.bias_gm_sigma_deg_per_h,
              gyro.bias_gm_correlation_time_s, gyro.arw_deg_per_sqrt_h);
    take("accel_b", "m/s^2", 1e5, "accel.bias_constant_mgal", accel.bias_constant_mgal, "x 1e5");
    take("accel_vrw", "m/s/sqrt(h)", 1.0, "accel.vrw_m_per_s_per_sqrt_h", accel.vrw_m_per_s_per_sqrt_h, "the same");
    take_bias("accel", "m/s^2", 1e5, 1.0 / 60.0, "accel.bias_gm_sigma_mgal", accel.bias_gm_sigma_mgal,
              accel.bias_gm_correlation_time_s, accel.vrw_m_per_s_per_sqrt_h);
    check_imported(file_, imported_.profile);
    return imported_;
  }

 private:
  Vector3 value(const std::string& key) {
    const auto found = values_.find(key);
    if (found == values_.end()) throw files::ReadError(file_ + ": has no '" + key + "'; gnss-ins-sim demands it");
    return found->second;
  }

  void take(const std::string& key, const char* unit, double scale, const char* target, Vector3& member,
            const char* how) {
    const Vector3 from = value(key);
    member = from * scale;
    imported_.lines.push_back(conversion_line(key, from, unit, target, member, how));
  }

  /// A finite correlation time makes a Gauss-Markov bias; an infinite or missing one white noise of that deviation at
  /// the simulation's rate. `per_sqrt_h`: deviation of one unit of the file at 1 Hz as a density a square root of an
  /// hour: deg/h / sqrt(Hz) = deg/sqrt(h)/60, m/s^2 / sqrt(Hz) = 60 m/s/sqrt(h).
  void take_bias(const std::string& triad, const char* unit, double scale, double file_units_per_density,
                 const char* target, Vector3& sigma, Vector3& time_s, Vector3& density) {
    const std::string stability = triad + "_b_stability";
    const Vector3 deviation = value(stability);
    Vector3 corr = Vector3::Constant(std::numeric_limits<double>::infinity());
    if (values_.count(triad + "_b_corr") != 0) corr = value(triad + "_b_corr");
    if (corr.array().isFinite().all()) {
      sigma = deviation * scale;
      time_s = corr;
      imported_.lines.push_back(conversion_line(
          stability, deviation, unit, target, sigma,
          std::string(scale == 1.0 ? "the same" : "x 1e5") +
              "; gnss-ins-sim drives it with sigma sqrt(1 - exp(-2 dt/T)), so it is the steady-state sigma"));
      imported_.lines.push_back(
          conversion_line(triad + "_b_corr", corr, "s", triad + ".bias_gm_correlation_time_s", corr, "the same"));
      return;
    }
    if (!corr.array().isInf().all()) throw files::ReadError(file_ + ": '" + triad + "_b_corr': some finite, some not");
    if (deviation.isZero(0.0)) return;
    if (!options_.rate_hz) {
      throw files::ReadError(file_ + ": '" + triad + "_b_corr' is missing or infinite, which in gnss-ins-sim makes '" +
                             stability + "' white noise of that deviation a sample; give its rate with --rate");
    }
    const Vector3 added = deviation / (file_units_per_density * std::sqrt(*options_.rate_hz));
    density = (density.array().square() + added.array().square()).sqrt();
    imported_.lines.push_back(
        conversion_line(stability, deviation, unit, "white noise, now", density,
                        fmt::format("without a correlation time it is white, {} / sqrt({:g} Hz), added by its square",
                                    stability, *options_.rate_hz)));
  }

  std::string file_;
  ImportOptions options_;
  std::map<std::string, Vector3> values_;
  ImportedProfile imported_;
};

}  // namespace

ImportedProfile import_gnss_ins_sim(const std::string& file, const ImportOptions& options) {
  return Conversion(file, options).run();
}

}  // namespace inslab::profile_import
