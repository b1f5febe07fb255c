#include "inslab/data/broadcast/gnss_signal.hpp"

#include <stdexcept>

namespace inslab::broadcast {

namespace {

constexpr double kL1_hz = 1575.42e6, kL2_hz = 1227.60e6, kL5_hz = 1176.45e6, kE5b_hz = 1207.14e6;
constexpr double kB1_hz = 1561.098e6, kB3_hz = 1268.52e6;

/// How many times the ionosphere's delay at L1 that at a frequency is.
constexpr double over_l1(double frequency_hz) { return (kL1_hz / frequency_hz) * (kL1_hz / frequency_hz); }

constexpr DelayRule kOnTime{0.0, 0.0}, kFirst{1.0, 0.0}, kSecond{0.0, 1.0};

// T_GD is the delay at L1 of a clock that is right for the pair L1, L2; of the others it is (f1/f)^2 times that while
// their own ISC is not known (IS-GPS-200, 20.3.3.3.3.2 and 30.3.3.3.1.1.1). Galileo's clock is that of I/NAV, right for
// the pair E1, E5b: BGD(E1,E5b) is the delay at E1, and at E5a what makes the pair E1, E5a late by BGD(E1,E5b) less
// BGD(E1,E5a) (OS SIS ICD, 5.1.5). BeiDou's clock is that of B3I; the delays of B1C and B2a stand in messages that are
// not simulated. Where BeiDou-2 sends B2I BeiDou-3 has B2b, whose chip rate that is. GLONASS's clock is that of G1.
const std::vector<GnssSignal> kSignals{
    {GnssSystem::Gps, "1C", kL1_hz, 0.0, 1.023e6, Modulation::Bpsk, false, 2, 0, 0, kFirst},
    {GnssSystem::Gps, "2L", kL2_hz, 0.0, 0.5115e6, Modulation::Bpsk, true, 16, 3, 3, {over_l1(kL2_hz), 0.0}},
    {GnssSystem::Gps, "5Q", kL5_hz, 0.0, 10.23e6, Modulation::Bpsk, true, 23, 7, 7, {over_l1(kL5_hz), 0.0}},
    {GnssSystem::Glonass, "1C", 1602e6, 562.5e3, 0.511e6, Modulation::Bpsk, false, 2, 0, 0, kOnTime},
    {GnssSystem::Glonass, "2C", 1246e6, 437.5e3, 0.511e6, Modulation::Bpsk, false, 8, 2, 2, kFirst},
    {GnssSystem::Galileo, "1C", kL1_hz, 0.0, 1.023e6, Modulation::BinaryOffset, true, 2, 0, 0, kSecond},
    {GnssSystem::Galileo, "7Q", kE5b_hz, 0.0, 10.23e6, Modulation::Bpsk, true, 15, 6, 6, {0.0, over_l1(kE5b_hz)}},
    {GnssSystem::Galileo, "5Q", kL5_hz, 0.0, 10.23e6, Modulation::Bpsk, true, 23, 4, 4, {over_l1(kL5_hz) - 1.0, 1.0}},
    {GnssSystem::BeiDou, "1P", kL1_hz, 0.0, 1.023e6, Modulation::BinaryOffset, true, 31, 5, 5, kOnTime},
    {GnssSystem::BeiDou, "2I", kB1_hz, 0.0, 2.046e6, Modulation::Bpsk, false, 2, 0, 1, kFirst},
    {GnssSystem::BeiDou, "6I", kB3_hz, 0.0, 10.23e6, Modulation::Bpsk, false, 8, 4, 10, kOnTime},
    {GnssSystem::BeiDou, "7I", kE5b_hz, 0.0, 10.23e6, Modulation::Bpsk, false, 14, 2, 3, kSecond},
    {GnssSystem::BeiDou, "5P", kL5_hz, 0.0, 10.23e6, Modulation::Bpsk, true, 23, 7, 7, kOnTime},
    {GnssSystem::Qzss, "1C", kL1_hz, 0.0, 1.023e6, Modulation::Bpsk, false, 2, 0, 0, kFirst},
    {GnssSystem::Qzss, "2L", kL2_hz, 0.0, 0.5115e6, Modulation::Bpsk, true, 16, 5, 5, {over_l1(kL2_hz), 0.0}},
    {GnssSystem::Qzss, "5Q", kL5_hz, 0.0, 10.23e6, Modulation::Bpsk, true, 23, 9, 9, {over_l1(kL5_hz), 0.0}},
};

}  // namespace

const std::vector<GnssSignal>& gnss_signals() { return kSignals; }

const GnssSignal& gnss_signal(GnssSystem system, std::string_view rinex) {
  for (const GnssSignal& signal : kSignals) {
    if (signal.system == system && signal.rinex == rinex) return signal;
  }
  throw std::out_of_range("no signal " + std::string(rinex) + " of " + std::string(enum_name(system)));
}

}  // namespace inslab::broadcast
