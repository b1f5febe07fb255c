#pragma once

#include <array>
#include <functional>

namespace CLI {
class App;
}

/// The subcommands of `inslab`. Each function declares its options on `app`; when the command line chose it, `action`
/// does the work and returns the exit code (foundation/host/exit_code.hpp).
namespace inslab::commands {

void add_run(CLI::App& app, std::function<int()>& action);
void add_summary(CLI::App& app, std::function<int()>& action);
void add_judge(CLI::App& app, std::function<int()>& action);
void add_follow(CLI::App& app, std::function<int()>& action);
void add_report(CLI::App& app, std::function<int()>& action);
void add_status(CLI::App& app, std::function<int()>& action);
void add_control(CLI::App& app, std::function<int()>& action);
void add_swap(CLI::App& app, std::function<int()>& action);
void add_topics(CLI::App& app, std::function<int()>& action);
void add_doctor(CLI::App& app, std::function<int()>& action);
void add_schedule(CLI::App& app, std::function<int()>& action);
void add_check(CLI::App& app, std::function<int()>& action);
void add_info(CLI::App& app, std::function<int()>& action);
void add_export(CLI::App& app, std::function<int()>& action);
void add_trajectory(CLI::App& app, std::function<int()>& action);

// Commands of the second program.
void add_navigate(CLI::App& app, std::function<int()>& action);
void add_montecarlo(CLI::App& app, std::function<int()>& action);
void add_align(CLI::App& app, std::function<int()>& action);
void add_allan(CLI::App& app, std::function<int()>& action);
void add_graft(CLI::App& app, std::function<int()>& action);
void add_graft_of_gnss(CLI::App& graft, std::function<int()>& action);
void add_profile(CLI::App& app, std::function<int()>& action);
void add_verify(CLI::App& app, std::function<int()>& action);
void add_simulate(CLI::App& app, std::function<int()>& action);
void add_plot(CLI::App& app, std::function<int()>& action);
void add_predict(CLI::App& app, std::function<int()>& action);
void add_reference(CLI::App& app, std::function<int()>& action);
void add_soak(CLI::App& app, std::function<int()>& action);

/// All commands of the program that this is linked into: live_commands.cpp or study_commands.cpp.
void add_commands(CLI::App& app, std::function<int()>& action);

/// A command that `inslab` hands on to the program inslab-study beside it: no live run needs it, and it is half of what
/// there is to build.
struct StudyCommand {
  const char* name;
  const char* purpose;
};
inline constexpr StudyCommand kNavigate{"navigate",
                                        "The reference navigation filter offline, on a log or on text files"};
inline constexpr StudyCommand kMontecarlo{
    "montecarlo", "Many seeded runs of a scenario with the reference navigation filter, and what they say together"};
inline constexpr StudyCommand kAlign{"align", "Attitude of an IMU at rest from gravity and the Earth's rate"};
inline constexpr StudyCommand kAllan{"allan", "Allan deviation of a recorded IMU at rest, and the noise model in it"};
inline constexpr StudyCommand kGraft{"graft", "Errors of a real IMU, taken out of a recording, for simulated ones"};
inline constexpr StudyCommand kProfile{"profile", "Make error profiles"};
inline constexpr StudyCommand kVerify{"verify", "Show the product's figures beside the published ones"};
inline constexpr StudyCommand kSimulate{"simulate",
                                        "Run a scenario in one process, without DDS, as fast as it goes; same samples"};
inline constexpr StudyCommand kPlot{"plot", "A picture of a scenario's or a log's track, height, speed and attitude"};
inline constexpr StudyCommand kPredict{
    "predict", "Errors to expect along a scenario from its sensors' profiles, its outages and its swaps"};
inline constexpr StudyCommand kReference{
    "reference", "Print a file derived from the parameter declarations: a schema, the profile IDL, the reference page"};
inline constexpr StudyCommand kSoak{
    "soak",
    "Run a scenario in lockstep for hours of sim time with random swaps, kills and pauses; 7 MB of log a minute"};
inline constexpr std::array kStudyCommands{kSimulate, kPlot,    kNavigate, kMontecarlo, kAlign, kAllan,
                                           kGraft,    kPredict, kProfile,  kVerify,     kSoak,  kReference};

/// The option --overwrite of a command that writes files: without it no file that is there already is replaced.
void add_overwrite(CLI::App& command);

}  // namespace inslab::commands
