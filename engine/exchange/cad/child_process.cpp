#include "engine/exchange/cad/child_process.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fmt/core.h>
#include <fstream>
#include <new>
#include <optional>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "engine/core/error.h"

namespace spia {
namespace {

enum class MessageKind : char { progress, log, result, fault };

/// What goes through the pipe: kind, length, bytes.
void send(int pipe, MessageKind kind, std::string_view bytes)
{
    const size_t length = bytes.size();
    std::string message(1, char(kind));
    message.append(reinterpret_cast<const char*>(&length), sizeof length).append(bytes);
    for (size_t at = 0; at < message.size();) {
        const ssize_t sent = ::write(pipe, message.data() + at, message.size() - at);
        if (sent < 0 && errno != EINTR)
            ::_exit(1); // nobody listens any more
        at += sent > 0 ? size_t(sent) : 0;
    }
}

void limit(int resource, rlim_t most)
{
    const rlimit both{most, most};
    ::setrlimit(__rlimit_resource_t(resource), &both);
}

void bound_this_process(std::chrono::seconds busy)
{
    long pages = 0;
    std::ifstream("/proc/self/statm") >> pages; // in use already: with a sanitizer that is
                                                // terabytes
    limit(RLIMIT_AS, rlim_t(pages) * rlim_t(::sysconf(_SC_PAGESIZE)) + (rlim_t(16) << 30));
    const auto most = rlim_t(busy.count());
    const rlimit cpu{most, most + 10}; // the kernel tells of the first; of the second it kills
                                       // without a word
    ::setrlimit(RLIMIT_CPU, &cpu);
    limit(RLIMIT_CORE, 0);
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDOUT_FILENO);
}

/// The kernel ends this process with the thread that started it: that one waits for the result, and
/// without it nobody does.
void end_with(pid_t parent)
{
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) // it was gone before
        ::_exit(1);
}

[[noreturn]] void be_the_child(int pipe, const std::function<std::string(const Progress&, const ChildLog&)>& work,
                               std::chrono::seconds busy)
{
    bound_this_process(busy);
    const Progress progress([&](double fraction, std::string_view step) {
        std::string bytes(reinterpret_cast<const char*>(&fraction), sizeof fraction);
        send(pipe, MessageKind::progress, bytes.append(step));
    });
    try {
        send(pipe, MessageKind::result,
             work(progress, [&](std::string_view text) { send(pipe, MessageKind::log, text); }));
    } catch (const std::bad_alloc&) {
        send(pipe, MessageKind::fault, "it needs more memory than there is; it is damaged or far too large");
    } catch (const std::exception& error) {
        send(pipe, MessageKind::fault, error.what());
    }
    ::_exit(0);
}

/// The child and the pipe from it; both are gone with this.
class Child {
public:
    Child(pid_t pid, int pipe) : pid_(pid), pipe_(pipe) {}
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child()
    {
        ::close(pipe_);
        if (pid_ > 0) {
            ::kill(pid_, SIGKILL);
            ended();
        }
    }
    int pipe() const { return pipe_; }
    double seconds() const ///< of computing; those of a child that has just ended stand still
    {
        clockid_t clock;
        timespec time{};
        if (::clock_getcpuclockid(pid_, &clock) != 0 || ::clock_gettime(clock, &time) != 0)
            return 0;
        return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
    }
    int ended() ///< waits for it
    {
        int status = 0;
        while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
        }
        pid_ = -1;
        return status;
    }

private:
    pid_t pid_;
    int pipe_;
};

/// How long a child has not computed, counted by our own looks: while this process stood still too,
/// there were none.
class Watchdog {
public:
    Watchdog(const Child& child, std::chrono::milliseconds between_looks, std::chrono::milliseconds most)
        : child_(child), step_(between_looks), most_(most)
    {
    }
    void look() ///< @throws InputError
    {
        const double now = child_.seconds();
        idle_ = now > last_ ? std::chrono::milliseconds(0) : idle_ + step_;
        last_ = now;
        if (idle_ > most_)
            throw InputError(fmt::format("reading it has made no progress for {} seconds; check that its disk "
                                         "responds, and try again or export it again",
                                         std::chrono::duration_cast<std::chrono::seconds>(most_).count()));
    }

private:
    const Child& child_;
    std::chrono::milliseconds step_, most_, idle_{0};
    double last_ = 0;
};

/// Takes the first whole message out of what has arrived.
std::optional<std::pair<MessageKind, std::string>> next_message(std::string& arrived)
{
    size_t length = 0;
    if (arrived.size() < 1 + sizeof length)
        return {};
    std::memcpy(&length, arrived.data() + 1, sizeof length);
    if (arrived.size() - 1 - sizeof length < length)
        return {};
    std::pair<MessageKind, std::string> message{MessageKind(arrived[0]), arrived.substr(1 + sizeof length, length)};
    arrived.erase(0, 1 + sizeof length + length);
    return message;
}

std::string result_of(Child& child, const ChildLog& log, const Progress& progress, const ChildLimits& limits)
{
    constexpr std::chrono::milliseconds between_looks{100}; // at whether the job is still wanted
    Watchdog watchdog(child, between_looks, limits.idle);
    double fraction = 0;
    std::string step = "reading the file", arrived, buffer(size_t(1) << 20, '\0');
    progress.checkpoint(fraction, step);
    for (;;) {
        pollfd waiting{child.pipe(), POLLIN, 0};
        const int ready = ::poll(&waiting, 1, int(between_looks.count()));
        if (ready == 0)
            watchdog.look();
        if (ready > 0) {
            const ssize_t got = ::read(child.pipe(), buffer.data(), buffer.size());
            if (got == 0)
                break;
            if (got > 0)
                arrived.append(buffer, 0, size_t(got));
        }
        while (auto message = next_message(arrived)) {
            auto& [kind, bytes] = *message;
            if (kind == MessageKind::result)
                return std::move(bytes);
            if (kind == MessageKind::fault)
                throw InputError(bytes);
            if (kind == MessageKind::log)
                log(bytes);
            else {
                std::memcpy(&fraction, bytes.data(), sizeof fraction);
                step = bytes.substr(sizeof fraction);
                progress.checkpoint(fraction, step);
            }
        }
        progress.checkpoint(fraction, step);
    }
    const int status = child.ended();
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        throw InputError(
            fmt::format("reading it was given up after {} seconds of computing; export it again, or a part of it",
                        limits.busy.count()));
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
        throw InputError(
            "reading it was ended from outside, perhaps because memory ran out; close other programs, or export a part "
            "of it");
    throw InputError(fmt::format("reading it crashed ({} {}): it is damaged; export it again",
                                 WIFSIGNALED(status) ? "signal" : "code",
                                 WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status)));
}

} // namespace

std::string in_child(const std::function<std::string(const Progress&, const ChildLog&)>& work, const ChildLog& log,
                     const Progress& progress, const ChildLimits& limits)
{
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
        throw InputError(fmt::format("no process can be started to read it ({})", std::strerror(errno)));
    const pid_t parent = ::getpid(), pid = ::fork();
    if (pid == 0) {
        end_with(parent);
        ::close(ends[0]);
        be_the_child(ends[1], work, limits.busy);
    }
    ::close(ends[1]);
    Child child(pid, ends[0]);
    if (pid < 0)
        throw InputError(fmt::format("no process can be started to read it ({})", std::strerror(errno)));
    return result_of(child, log, progress, limits);
}

} // namespace spia
