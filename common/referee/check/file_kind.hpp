#pragma once

#include <optional>
#include <string>

#include "inslab/scenario/document_kind.hpp"

namespace inslab::check {

/// What a file is, seen from what is in it and not from its name.
struct FileKind {
  enum class Form {
    Document,      ///< JSON
    Log,           ///< MCAP
    Recording,     ///< text: samples of an IMU
    Trajectory,    ///< text: positions over time, fixes of a receiver too
    MotionMatrix,  ///< text: the segments of a trajectory, four columns
    NovatelLog,    ///< text: RAWIMU lines
    Unknown,
  };
  Form form = Form::Unknown;
  std::optional<scenario::DocumentKind> document;  ///< of a JSON file whose keys are known
  json::Json json;                                 ///< of a JSON file
};

/// Throws json::Error or files::ReadError when the file cannot be read.
FileKind file_kind(const std::string& path);

}  // namespace inslab::check
