#include "tests/fuzz/cad_copy.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <fstream>
#include <new>
#include <sanitizer/asan_interface.h>
#include <string_view>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#include <utility>

#include "tests/fuzz/crash_owner.h"

namespace spia::fuzz {
namespace {

constexpr time_t enough = 2;               // seconds of computing for one file of a few kilobytes
constexpr int most_looks = 20;             // then, at whose code it is busy
constexpr suseconds_t between = 20'000;    // us
constexpr rlim_t memory = rlim_t(4) << 30; // more than there is in use
constexpr size_t longest_place = 200;

/// Where a copy was ended: outlives it.
char* shared_place()
{
    static char* const place = [] {
        void* const page = ::mmap(nullptr, longest_place, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        if (page == MAP_FAILED)
            throw std::bad_alloc();
        return static_cast<char*>(page);
    }();
    return place;
}

/// Where a fault is, is said.
[[noreturn]] void end_here(Outcome outcome, const Place& place, const char* fault_text = "")
{
    put_name(place.code, shared_place(), longest_place);
    if (outcome == fault)
        std::fprintf(stderr, "%s in the reader at %s\n", fault_text, shared_place());
    ::_exit(outcome);
}

void end_by_signal(int, siginfo_t*, void* context)
{
    const Place place = place_of_signal(context);
    end_here(place.owner == Owner::opencascade ? crashed : fault, place, "a signal");
}

volatile std::sig_atomic_t looks = 0, in_opencascade = 0;

void set_timer(itimerval first) { ::setitimer(ITIMER_PROF, &first, nullptr); }

/// Loops of the reader may call OpenCASCADE: so not the first look counts, but most of them. (One
/// that is there most of the time counts as OpenCASCADE's.)
void look_while_busy(int, siginfo_t*, void* context)
{
    const Place place = place_of_signal(context);
    in_opencascade = in_opencascade + (place.owner == Owner::opencascade);
    looks = looks + 1;
    if (looks < most_looks)
        set_timer({{}, {0, between}});
    else
        end_here(2 * in_opencascade > looks ? endless : fault, place, "busy");
}

void end_by_report(const char*)
{
    const std::string_view what = __asan_get_report_description();
    const bool hungry = what == "out-of-memory" || what == "allocation-size-too-big" || what == "calloc-overflow";
    const Place place = place_on_stack();
    if (place.owner == Owner::opencascade)
        end_here(hungry ? too_much : crashed, place);
    end_here(fault, place, "the report above,");
}

void take_over_handlers()
{
    struct sigaction action {};
    action.sa_sigaction = end_by_signal;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
        ::sigaction(signal, &action, nullptr);
    action.sa_sigaction = look_while_busy;
    action.sa_flags |= SA_RESTART;
    ::sigaction(SIGPROF, &action, nullptr);
    __asan_set_error_report_callback(end_by_report);
    // The other sanitizer reports what is instrumented: the reader, and what it has of
    // OpenCASCADE's headers.
    __sanitizer_set_death_callback([] {
        const Place place = place_on_stack();
        end_here(place.owner == Owner::opencascade ? crashed : fault, place, "the report above,");
    });
}

void bound_this_process(pid_t parent)
{
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    long pages = 0;
    std::ifstream("/proc/self/statm") >> pages; // a sanitizer has terabytes
    if (pages == 0 || ::getppid() != parent)
        ::_exit(0);
    const rlim_t most = rlim_t(pages) * rlim_t(::sysconf(_SC_PAGESIZE)) + memory;
    const rlimit both{most, most};
    ::setrlimit(RLIMIT_AS, &both);
    ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO); // what OpenCASCADE prints
}

Outcome outcome_here(const CadReader& reads, const std::filesystem::path& file)
{
    looks = in_opencascade = 0;
    set_timer({{}, {enough, 0}});
    try {
        return reads(file) ? accepted : refused;
    } catch (const std::exception& wrong) { // no memory, too: OpenCASCADE throws something else
                                            // then
        std::fprintf(stderr, "what(): %s\n", wrong.what());
    } catch (...) {
        std::fputs("what(): no std::exception\n", stderr);
    }
    return fault;
}

/// libFuzzer looks at the clock now and then.
template <class Call> auto in_spite_of_alarms(const Call& call)
{
    for (;;)
        if (const auto result = call(); result >= 0 || errno != EINTR)
            return result;
}

} // namespace

CadCopy::CadCopy(CadReader reads, std::filesystem::path file) : reads_(std::move(reads)), file_(std::move(file))
{
    shared_place();
}

CadCopy::~CadCopy() { end(); }

Outcome CadCopy::read()
{
    constexpr int most = 1000; // OpenCASCADE leaves memory behind
    if (files_ >= most)
        end();
    if (copy_ < 0)
        start();
    ++files_;
    char outcome = 0;
    if (in_spite_of_alarms([&] { return ::write(to_, "g", 1); }) == 1 &&
        in_spite_of_alarms([&] { return ::read(from_, &outcome, 1); }) == 1)
        return Outcome(outcome);
    return outcome_of_end(false);
}

double CadCopy::seconds() const
{
    clockid_t clock;
    timespec time{};
    if (copy_ < 0 || ::clock_getcpuclockid(copy_, &clock) != 0 || ::clock_gettime(clock, &time) != 0)
        return 0;
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

std::string CadCopy::place() const { return shared_place(); }

void CadCopy::end()
{
    if (copy_ < 0)
        return;
    ::kill(copy_, SIGKILL);
    outcome_of_end(true);
}

void CadCopy::start()
{
    int there[2], back[2];
    const pid_t parent = ::getpid();
    if (::pipe2(there, O_CLOEXEC) != 0 || ::pipe2(back, O_CLOEXEC) != 0 || (copy_ = ::fork()) < 0) {
        std::perror("no copy of this process");
        std::exit(2);
    }
    if (copy_ == 0) {
        ::close(there[1]);
        take_over_handlers();
        bound_this_process(parent);
        for (char go; ::read(there[0], &go, 1) == 1;) {
            const char outcome = char(outcome_here(reads_, file_));
            set_timer({});
            if (::write(back[1], &outcome, 1) != 1)
                break;
        }
        ::_exit(0);
    }
    ::close(there[0]);
    ::close(back[1]);
    to_ = there[1];
    from_ = back[0];
    files_ = 0;
    *shared_place() = '\0';
}

Outcome CadCopy::outcome_of_end(bool asked_for)
{
    ::close(to_);
    ::close(from_);
    int status = 0;
    in_spite_of_alarms([&] { return ::waitpid(copy_, &status, 0); });
    copy_ = -1;
    if (WIFEXITED(status) && WEXITSTATUS(status) >= refused && WEXITSTATUS(status) <= fault)
        return Outcome(WEXITSTATUS(status));
    if (!asked_for)
        std::fprintf(stderr, "a copy ended with status %d\n", status);
    return fault;
}

} // namespace spia::fuzz
