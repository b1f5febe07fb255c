#pragma once

#include <cstddef>
#include <cstdint>

/// How large, how deep and how many: what every input of Inslab may be at most. Whatever is beyond is refused at once,
/// with the file, the place and the limit. docs/formats.md lists them.
namespace inslab::files {

/// Scenarios, profiles, parameters, schedules, results of runs (JSON).
inline constexpr std::size_t kMaxJsonBytes = std::size_t{128} << 20;
inline constexpr std::size_t kMaxJsonValues = 4'000'000;  ///< numbers, words, lists and objects together
inline constexpr std::size_t kMaxJsonLevels = 32;         ///< objects and lists in each other; a scenario has 6

/// Files of other programs that profiles are imported from.
inline constexpr std::size_t kMaxImportBytes = std::size_t{4} << 20;
inline constexpr std::size_t kMaxImportLevels = 64;  ///< brackets, elements or sections in each other

/// Texts of rows (trajectories, recordings, fixes, matrices of segments, NovAtel lines).
inline constexpr std::size_t kMaxLineBytes = std::size_t{1} << 16;
inline constexpr std::size_t kMaxRowsInMemory = 20'000'000;  ///< of trajectories and fixes: 27 h at 200 Hz

/// Logs (MCAP).
inline constexpr std::uint64_t kMaxLogRecordBytes = std::uint64_t{1} << 28;  ///< of a chunk after decompression, too
inline constexpr std::uint64_t kMaxOpenLogBytes = std::uint64_t{1} << 30;    ///< of chunks that overlap in time

}  // namespace inslab::files
