#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "inslab/foundation/fields/field.hpp"
#include "inslab/foundation/time/gps_time.hpp"

/// What the pure models must not know: clocks, the process, the machine.
namespace inslab::host {

time::Nanoseconds realtime_now();   ///< CLOCK_REALTIME
time::Nanoseconds monotonic_now();  ///< CLOCK_MONOTONIC

/// Sleeps until CLOCK_MONOTONIC shows `deadline`, to the microsecond: the last part is spun. Returns early on a signal.
void sleep_until(time::Nanoseconds deadline);

/// Asks the kernel for precise wake-ups of this thread.
void use_precise_timers();

std::uint64_t random_id();  ///< for requests
RunId random_run_id();
std::string run_id_text(const RunId& run_id);             ///< 32 hexadecimal digits
std::optional<RunId> run_id_of(const std::string& text);  ///< of that text; nothing when it is none

std::string host_name();
std::uint32_t process_id();
std::uint64_t resident_bytes();
/// Where a process id counts: this boot of this machine, and its PID namespace. Containers of one host differ.
std::string process_space();
/// When a process of this process space started, in clock ticks since the boot; nothing when it has ended.
std::optional<std::uint64_t> started_ticks(std::uint32_t pid);
/// The instruction set level that the bits of a run depend on, such as "x86-64 avx2 fma".
std::string cpu_features();
/// UTC as 20260131T235959Z.
std::string utc_text(time::Nanoseconds realtime);

/// The same to be read: "2026-11-29 04:20:11 UTC".
std::string utc_words(time::Nanoseconds realtime);

}  // namespace inslab::host
