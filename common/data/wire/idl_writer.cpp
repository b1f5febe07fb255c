#include "inslab/data/wire/idl_writer.hpp"

#include <set>
#include <sstream>

#include "inslab/data/catalog/wire_type.hpp"

namespace inslab::wire {

namespace {

/// Names of the structs that only occur inside profiles.
template <class T>
struct NestedName;
template <>
struct NestedName<ProfileRequest> {
  static constexpr std::string_view value = "ProfileRequest";
};
template <>
struct NestedName<GyroErrors> {
  static constexpr std::string_view value = "GyroErrors";
};
template <>
struct NestedName<AccelErrors> {
  static constexpr std::string_view value = "AccelErrors";
};
template <>
struct NestedName<LesserSolution> {
  static constexpr std::string_view value = "LesserSolution";
};
template <>
struct NestedName<LesserBaseline> {
  static constexpr std::string_view value = "LesserBaseline";
};
template <>
struct NestedName<DaysAir> {
  static constexpr std::string_view value = "DaysAir";
};
template <>
struct NestedName<WindField> {
  static constexpr std::string_view value = "WindField";
};
template <>
struct NestedName<WindLevel> {
  static constexpr std::string_view value = "WindLevel";
};
template <>
struct NestedName<PressureSensorErrors> {
  static constexpr std::string_view value = "PressureSensorErrors";
};
template <>
struct NestedName<VaneErrors> {
  static constexpr std::string_view value = "VaneErrors";
};
template <>
struct NestedName<LinearSinusoid> {
  static constexpr std::string_view value = "LinearSinusoid";
};
template <>
struct NestedName<AngularSinusoid> {
  static constexpr std::string_view value = "AngularSinusoid";
};
template <>
struct NestedName<TemperaturePoint> {
  static constexpr std::string_view value = "TemperaturePoint";
};
template <>
struct NestedName<RecordedError> {
  static constexpr std::string_view value = "RecordedError";
};
template <>
struct NestedName<RecordedFixError> {
  static constexpr std::string_view value = "RecordedFixError";
};
template <>
struct NestedName<PulseErrors> {
  static constexpr std::string_view value = "PulseErrors";
};
template <>
struct NestedName<LinearRandomPoint> {
  static constexpr std::string_view value = "LinearRandomPoint";
};
template <>
struct NestedName<AngularRandomPoint> {
  static constexpr std::string_view value = "AngularRandomPoint";
};
template <>
struct NestedName<TimeTagErrors> {
  static constexpr std::string_view value = "TimeTagErrors";
};
template <>
struct NestedName<ChannelFault> {
  static constexpr std::string_view value = "ChannelFault";
};
template <>
struct NestedName<TimeTagStep> {
  static constexpr std::string_view value = "TimeTagStep";
};
template <>
struct NestedName<CurrentField> {
  static constexpr std::string_view value = "CurrentField";
};
template <>
struct NestedName<MagneticBody> {
  static constexpr std::string_view value = "MagneticBody";
};

/// Collects the definitions of a type and of everything it holds, each once, in the order of dependence.
class IdlWriter {
 public:
  template <class Enum>
  void is_declared_elsewhere() {
    done_.insert(std::string(EnumNames<Enum>::type));
  }

  template <class Enum>
  void write_enum() {
    if (!done_.insert(std::string(EnumNames<Enum>::type)).second) return;
    text_ << "  enum " << EnumNames<Enum>::type << " {\n    ";
    bool first = true;
    for (const std::string_view value : EnumNames<Enum>::values) {
      text_ << (first ? "" : ", ") << EnumNames<Enum>::prefix << upper(value);
      first = false;
    }
    text_ << "\n  };\n\n";
  }

  template <class T>
  void write_struct(std::string_view name, std::string_view comment) {
    if (!done_.insert(std::string(name)).second) return;
    Members members{*this, {}};
    T value;
    T::fields(value, members);
    if (!comment.empty()) text_ << "  // " << comment << "\n";
    text_ << "  @final struct " << name << " {\n" << members.lines.str() << "  };\n\n";
  }

  std::string text() const { return text_.str(); }

 private:
  struct Members {
    IdlWriter& writer;
    std::ostringstream lines;

    template <class T>
    void operator()(const Field& field, T&) {
      std::string line = std::string("    ") + (field.is_key ? "@key " : "") + writer.declaration<T>(field) + ";";
      if (!field.meaning.empty()) {
        if (line.size() < 52) line.resize(52, ' ');
        line += "  // " + std::string(field.meaning);
      }
      lines << line << "\n";
    }
  };

  static std::string upper(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return out;
  }

  template <class T>
  std::string type_name(const Field& field) {
    if constexpr (std::is_same_v<T, bool>) {
      return "boolean";
    } else if constexpr (std::is_enum_v<T>) {
      write_enum<T>();
      return std::string(EnumNames<T>::type);
    } else if constexpr (std::is_same_v<T, std::uint32_t>) {
      return "unsigned long";
    } else if constexpr (std::is_same_v<T, std::uint64_t>) {
      return "unsigned long long";
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
      return "long long";
    } else if constexpr (std::is_same_v<T, double>) {
      return "double";
    } else if constexpr (std::is_same_v<T, std::string>) {
      return "string<" + std::to_string(field.max_size) + ">";
    } else if constexpr (is_list<T>) {
      return "sequence<" + type_name<typename T::value_type>(field) + ", " + std::to_string(field.max_size) + ">";
    } else {
      static_assert(has_fields<T>, "a field of a kind that profiles do not have");
      write_struct<T>(NestedName<T>::value, "");
      return std::string(NestedName<T>::value);
    }
  }

  template <class T>
  std::string declaration(const Field& field) {
    const std::string name(field.name);
    if constexpr (std::is_same_v<T, Vector3>) {
      return "double " + name + "[3]";
    } else if constexpr (std::is_same_v<T, Vector6>) {
      return "double " + name + "[6]";
    } else if constexpr (std::is_same_v<T, Vector9>) {
      return "double " + name + "[9]";
    } else {
      return type_name<T>(field) + " " + name;
    }
  }

  std::set<std::string> done_;
  std::ostringstream text_;
};

template <class T>
std::string name_in_idl() {
  return std::string(catalog::WireType<T>::name.substr(catalog::kModule.size()));
}

/// The topic of the blocks of a stream, that of sensors for any of them: "inslab/block/imu/N".
template <class Sample>
std::string blocks_of() {
  std::string stream;
  if constexpr (catalog::is_of_a_sensor<Sample>) {
    stream = catalog::stream_topic<Sample>(0);
    stream.replace(stream.size() - 1, 1, "N");
  } else {
    for_each_of(catalog::kTopics, [&stream](const auto& topic) {
      if (std::is_same_v<typename std::decay_t<decltype(topic)>::Type, Sample>) stream = topic.name;
    });
  }
  return catalog::block_topic(stream);
}

}  // namespace

std::string profile_idl() {
  IdlWriter writer;
  writer.is_declared_elsewhere<FixType>();
  writer.write_enum<ProfileKind>();
  for_each(catalog::ProfileKinds{}, [&writer](auto tag) {
    using Profile = typename decltype(tag)::type;
    writer.write_struct<Profile>(name_in_idl<Profile>(), "Topic " + catalog::request_topic(Profile::kind) + ": " +
                                                             std::string(catalog::kWords<Profile>.meaning) + ".");
  });

  std::string text =
      "// Inslab wire types, part 6 of 14: the profiles that can be swapped while a run goes on. A request and its "
      "entry in\n"
      "// the journal have the same type. What is not wanted stays zero; a list that is not wanted stays empty.\n"
      "// Derived from the parameter declarations in common/data/profiles by 'inslab reference idl/profile.idl'.\n"
      "#ifndef INSLAB_PROFILE_IDL\n#define INSLAB_PROFILE_IDL\n\n#include \"gnss.idl\"\n\nmodule inslab { module v5 "
      "{\n\n";
  return text + writer.text() + "}; };\n\n#endif\n";
}

std::string block_idl() {
  std::set<std::string_view> included;
  std::string includes, structs;
  for_each(catalog::StreamSamples{}, [&](auto tag) {
    using Sample = typename decltype(tag)::type;
    using Type = catalog::WireType<Sample>;
    if (included.insert(Type::idl_file).second) includes += "#include \"" + std::string(Type::idl_file) + "\"\n";
    structs += "\n  // Topic " + blocks_of<Sample>() + ".\n  @final struct " + name_in_idl<Block<Sample>>() +
               " {\n    sequence<" + name_in_idl<Sample>() + ", " + std::to_string(Block<Sample>::kMaxSamples) +
               "> samples;\n  };\n";
  });
  return "// Inslab wire types, part 9 of 14: many samples of a stream in one message, for lockstep alone. Sequence "
         "numbers go on\n// from block to block as in the stream. Derived from the streams in common/data/catalog by "
         "'inslab reference\n// idl/block.idl'.\n#ifndef INSLAB_BLOCK_IDL\n#define INSLAB_BLOCK_IDL\n\n" +
         includes + "\nmodule inslab { module v5 {\n" + structs + "\n}; };\n\n#endif\n";
}

}  // namespace inslab::wire
