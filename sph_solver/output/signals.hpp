/// Signals that ask a run to stop: they set a flag, and the main loop leaves a checkpoint before it ends.
#pragma once

#include <csignal>

namespace cupel
{

/// The signal that asked for the end of the run; 0 as long as none did.
inline volatile std::sig_atomic_t stop_signal = 0;

inline bool stop_requested()
{
    return stop_signal != 0;
}

/// Exit status of a run that a signal ended after it left a checkpoint.
inline constexpr int interrupted_exit_status = 130;

/// From now on SIGINT and SIGTERM set the flag, and a closed pipe or a limit on file size is an error of the write that
/// meets it instead of the end of the program. The third signal ends the program at once; the second does not, because
/// a terminal's Ctrl-C comes twice where the caller passes it on as well.
inline void catch_stop_signals()
{
    struct sigaction action
    {};
    action.sa_handler = [](int signal) {
        static volatile std::sig_atomic_t received = 0;
        received = received + 1;
        stop_signal = signal;
        if (received >= 3) {
            std::signal(signal, SIG_DFL);
            std::raise(signal);
        }
    };
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

} // namespace cupel
