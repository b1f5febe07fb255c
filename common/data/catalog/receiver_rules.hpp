#pragma once

#include "inslab/data/catalog/correlation_rule.hpp"
#include "inslab/data/profiles/gnss_error_profile.hpp"
#include "inslab/data/profiles/heading_error_profile.hpp"

/// Rules of receivers of satellites: what they claim at their best, and the ladder up to it.
namespace inslab::catalog::detail {

/// `path` ends before the field's name, such as "lesser_solutions[1].".
inline std::optional<Violation> solution_violation(const std::string& path, const SolutionErrors& errors) {
  if (auto broken = correlation_violation(path + "position_gm_correlation_time_s", "position_gm_sigma_ned_m",
                                          errors.position_gm_sigma_ned_m, errors.position_gm_correlation_time_s)) {
    return broken;
  }
  return correlation_violation(path + "velocity_gm_correlation_time_s", "velocity_gm_sigma_ned_m_per_s",
                               errors.velocity_gm_sigma_ned_m_per_s, errors.velocity_gm_correlation_time_s);
}

inline std::optional<Violation> solution_violation(const std::string& path, const BaselineErrors& errors) {
  return correlation_violation(path + "relative_gm_correlation_time_s", "relative_gm_sigma_ned_m",
                               errors.relative_gm_sigma_ned_m, errors.relative_gm_correlation_time_s);
}

/// Of a receiver, whose best solution is a fix and whose lesser ones go up to it.
template <class Profile>
std::optional<Violation> ladder_violation(const Profile& profile) {
  for (std::size_t i = 0; i < profile.lesser_solutions.size(); ++i) {
    const auto& solution = profile.lesser_solutions[i];
    const std::string path = "lesser_solutions[" + std::to_string(i) + "].";
    const FixType better =
        i + 1 < profile.lesser_solutions.size() ? profile.lesser_solutions[i + 1].fix_type : profile.fix_type;
    if (!(solution.fix_type < better)) {
      return Violation{Rule::SolutionsAscend, path + "fix_type",
                       "is " + std::string(enum_name(solution.fix_type)) + "; expected a worse one than " +
                           std::string(enum_name(better)) + ", which comes next"};
    }
    if (auto broken = solution_violation(path, solution)) return broken;
  }
  return std::nullopt;
}

template <class Profile>
std::optional<Violation> fix_type_violation(const Profile& profile) {
  if (profile.fix_type != FixType::None) return std::nullopt;
  return Violation{Rule::FixTypeGiven, "fix_type", "is none; a receiver without a fix is the fault 'outage'"};
}

}  // namespace inslab::catalog::detail
