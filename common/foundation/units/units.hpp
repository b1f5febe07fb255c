#pragma once

/// Units of data sheets in SI: multiply by the constant. Profiles are converted once, when a model takes them.
namespace inslab::units {

inline constexpr double kPi = 3.14159265358979323846;

inline constexpr double kDeg = kPi / 180.0;                  ///< rad
inline constexpr double kDegPerRad = 180.0 / kPi;            ///< deg, to show an angle
inline constexpr double kArcsec = kDeg / 3600.0;             ///< rad
inline constexpr double kDegPerS = kDeg;                     ///< rad/s
inline constexpr double kDegPerH = kDeg / 3600.0;            ///< rad/s
inline constexpr double kDegPerSqrtH = kDeg / 60.0;          ///< rad/sqrt(s)
inline constexpr double kMGal = 1e-5;                        ///< m/s^2
inline constexpr double kMPerSPerSqrtH = 1.0 / 60.0;         ///< m/s/sqrt(s)
inline constexpr double kDegPerHPerSqrtH = kDegPerH / 60.0;  ///< rad/s/sqrt(s)
inline constexpr double kMGalPerSqrtH = kMGal / 60.0;        ///< m/s^2/sqrt(s)
inline constexpr double kG = 9.80665;                        ///< m/s^2, standard gravity: the g of data sheets
inline constexpr double kPpm = 1e-6;                         ///< 1

}  // namespace inslab::units
