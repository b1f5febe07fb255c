#pragma once

#include <limits>
#include <string>
#include <vector>

#include "inslab/foundation/fields/field.hpp"

namespace inslab::test {

/// What a broken or hostile client puts into a field.
enum class Spoil { Text, Enumerator, Length, NotANumber };

/// Copies of a sample of type T, each with one field as nobody should send it: a text that is not UTF-8, with a control
/// character or too long, an enumerator that does not exist, a list that is too long; or not-a-number in every number.
template <class T>
class SpoiledFields {
 public:
  struct Sample {
    std::string field;
    T value;
  };

  /// Those that no decoder may accept.
  static std::vector<Sample> refused() {
    std::vector<Sample> all = each(Spoil::Text, kTexts);
    for (const auto& [spoil, ways] : {std::pair{Spoil::Enumerator, 2}, std::pair{Spoil::Length, 1}}) {
      const std::vector<Sample> more = each(spoil, ways);
      all.insert(all.end(), more.begin(), more.end());
    }
    return all;
  }

  /// The sample whose real numbers are none: for the rules of whoever reads it.
  static T without_numbers() {
    T value{};
    Walk walk{Spoil::NotANumber, 0, -1};
    T::fields(value, walk);
    return value;
  }

 private:
  static constexpr int kTexts = 4;

  /// Visits the fields and spoils number `target` of those that can be spoiled so; all of them when that is -1.
  struct Walk {
    Spoil spoil;
    int way;
    int target;
    int count = 0;
    std::string name{};

    template <class V>
    void operator()(const Field& field, V& value) {
      visit(field, value);
    }
    bool is_next(const Field& field) {
      const bool chosen = target == -1 || count == target;
      ++count;
      if (chosen) name = std::string(field.name);
      return chosen;
    }
    template <class V>
    void visit(const Field& field, V& value) {
      if constexpr (std::is_same_v<V, std::string>) {
        if (spoil == Spoil::Text && is_next(field)) value = text(field.max_size);
      } else if constexpr (std::is_same_v<V, RunId> || std::is_same_v<V, bool>) {
        return;
      } else if constexpr (std::is_enum_v<V>) {
        const auto end = EnumNames<V>::values.size();
        if (spoil == Spoil::Enumerator && is_next(field)) value = static_cast<V>(way == 0 ? end : 0xffffffffU);
      } else if constexpr (std::is_same_v<V, double>) {
        if (spoil == Spoil::NotANumber) value = std::numeric_limits<double>::quiet_NaN();
      } else if constexpr (std::is_arithmetic_v<V>) {
        return;
      } else if constexpr (std::is_same_v<V, Quaternion>) {
        if (spoil == Spoil::NotANumber) value.coeffs().setConstant(std::numeric_limits<double>::quiet_NaN());
      } else if constexpr (is_list<V>) {
        if (spoil == Spoil::Length && is_next(field)) {
          value.resize(field.max_size + 1);
          return;
        }
        value.resize(1);
        for (auto& element : value) visit(field, element);
      } else if constexpr (has_fields<V>) {
        V::fields(value, *this);
      } else if (spoil == Spoil::NotANumber) {
        value.setConstant(std::numeric_limits<double>::quiet_NaN());
      }
    }
    std::string text(std::size_t longest) const {
      const std::string kinds[kTexts] = {"\xff\xfe not UTF-8", "\x1b[2J", std::string("a\0b", 3),
                                         std::string(longest + 1, 'n')};
      return kinds[way];
    }
  };

  static std::vector<Sample> each(Spoil spoil, int ways) {
    std::vector<Sample> samples;
    for (int way = 0; way < ways; ++way) {
      for (int target = 0;; ++target) {
        Sample sample{"", T{}};
        Walk walk{spoil, way, target};
        T::fields(sample.value, walk);
        if (walk.count <= target) break;
        sample.field = walk.name;
        samples.push_back(sample);
      }
    }
    return samples;
  }
};

}  // namespace inslab::test
