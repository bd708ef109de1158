#include "tests/fuzz/cad_fuzz.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <exception>
#include <execinfo.h>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <new>
#include <sanitizer/asan_interface.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <ucontext.h>
#include <unistd.h>

#include "tests/fuzz/cad_search.h"

/// The counters of this program's branches, which libFuzzer looks at; the linker names their begin and end.
extern "C" __attribute__((visibility("hidden"))) std::uint8_t __start___sancov_cntrs[], __stop___sancov_cntrs[];

/// A name for each place in a report would take longer than a thousand files; what is found is read again with them.
extern "C" const char* __asan_default_options()
{
    return "detect_leaks=0:allocator_may_return_null=1:symbolize=0:malloc_context_size=1:quarantine_size_mb=8";
}

namespace spia::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr int enough = 2;                  // seconds of computing for one file of a few kilobytes
constexpr rlim_t memory = rlim_t(4) << 30; // more than there is in use
constexpr std::array crashes = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

/// What becomes of a file.
enum Outcome { refused = 40, accepted, crashed, too_much, endless, fault };

/// Counts in the copies are counts here.
class SharedCoverage {
public:
    SharedCoverage()
    {
        if (size_ > 0 &&
            ::mmap(begin_, size_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_FIXED, -1, 0) == MAP_FAILED)
            throw std::bad_alloc();
    }
    void forget() { std::memset(begin_, 0, size_); }

private:
    // The first and the last page hold other data, too, and are left out.
    static char* page_of(std::uint8_t* counter, size_t into)
    {
        const auto page = std::uintptr_t(::sysconf(_SC_PAGESIZE));
        return reinterpret_cast<char*>((std::uintptr_t(counter) + into) / page * page);
    }
    char* begin_ = page_of(__start___sancov_cntrs, size_t(::sysconf(_SC_PAGESIZE)) - 1);
    size_t size_ = size_t(std::max(page_of(__stop___sancov_cntrs, 0) - begin_, std::ptrdiff_t(0)));
};

enum class Owner { unknown, opencascade, reader };

/// Whose code that is: OpenCASCADE's, or the reader's; neither, if it is a library's that both use.
Owner owner_of(const void* code)
{
    Dl_info info{};
    if (::dladdr(code, &info) == 0 || !info.dli_fname)
        return Owner::unknown;
    if (std::strstr(info.dli_fname, "libTK"))
        return Owner::opencascade;
    if (std::strstr(info.dli_fname, ".so"))
        return Owner::unknown;
    // This program holds the sanitizers' functions and templates of other libraries besides. What has no name here is the sanitizers', or
    // the reader's own and called by what has one.
    return info.dli_sname && std::strstr(info.dli_sname, "4spia") ? Owner::reader : Owner::unknown;
}

/// The innermost one on the stack.
Owner owner_of_stack(int skipped)
{
    std::array<void*, 64> frame;
    const int frames = ::backtrace(frame.data(), int(frame.size()));
    for (int k = skipped; k < frames; ++k)
        if (const Owner owner = owner_of(frame[size_t(k)]); owner != Owner::unknown)
            return owner;
    return Owner::unknown;
}

void end_by_signal(int signal, siginfo_t*, void* context)
{
    const greg_t* const registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
    Owner owner = owner_of(reinterpret_cast<void*>(registers[REG_RIP]));
    if (owner == Owner::unknown)
        owner = owner_of_stack(2); // without this function, and what called it
    if (owner == Owner::unknown)   // called by a broken pointer: where from is the last word of the stack
        owner = owner_of(*reinterpret_cast<void**>(registers[REG_RSP]));
    if (owner != Owner::opencascade) {
        std::fprintf(stderr, "signal %d in the reader\n", signal);
        ::_exit(fault);
    }
    ::_exit(crashed);
}

void end_by_report(const char* text)
{
    const std::string_view what = __asan_get_report_description();
    if (what == "out-of-memory" || what == "allocation-size-too-big" || what == "calloc-overflow")
        ::_exit(too_much);
    if (owner_of_stack(1) == Owner::opencascade)
        ::_exit(crashed);
    std::fputs(text, stderr);
    ::_exit(fault);
}

void bound_this_process()
{
    long pages = 0;
    std::ifstream("/proc/self/statm") >> pages; // a sanitizer has terabytes
    const rlim_t most = rlim_t(pages) * rlim_t(::sysconf(_SC_PAGESIZE)) + memory;
    const rlimit both{most, most};
    ::setrlimit(RLIMIT_AS, &both);
    ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO); // what OpenCASCADE prints
}

void take_over_handlers()
{
    struct sigaction action {};
    action.sa_sigaction = end_by_signal;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    for (const int signal : crashes)
        ::sigaction(signal, &action, nullptr);
    ::signal(SIGPROF, SIG_DFL);
    __asan_set_error_report_callback(end_by_report);
    __sanitizer_set_death_callback(
        [] { ::_exit(fault); }); // the other sanitizer reports only what is instrumented: the reader
}

Outcome outcome_here(const fs::path& file)
{
    const itimerval time{{}, {enough, 0}};
    ::setitimer(ITIMER_PROF, &time, nullptr); // ends this process
    try {
        return read_and_examine(file) ? accepted : refused;
    } catch (const std::bad_alloc&) {
        return too_much;
    } catch (const std::exception& wrong) {
        std::fprintf(stderr, "%s\n", wrong.what());
        return fault;
    }
}

/// libFuzzer looks at the clock now and then.
template <class Call> auto in_spite_of_alarms(const Call& call)
{
    for (;;)
        if (const auto result = call(); result >= 0 || errno != EINTR)
            return result;
}

/// A copy of this process that reads one file after the other until one ends it: to copy takes longer than to read.
class Reader {
public:
    explicit Reader(fs::path file) : file_(std::move(file)) {}
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader()
    {
        if (copy_ >= 0)
            end();
    }

    /// Of what the file holds now.
    Outcome read()
    {
        constexpr int most = 1000; // OpenCASCADE leaves memory behind
        if (copy_ >= 0 && files_ >= most)
            end();
        if (copy_ < 0)
            start();
        ++files_;
        char outcome = 0;
        if (in_spite_of_alarms([&] { return ::write(to_, "g", 1); }) == 1 &&
            in_spite_of_alarms([&] { return ::read(from_, &outcome, 1); }) == 1)
            return Outcome(outcome);
        return end();
    }
    double seconds() const ///< of computing; 0 if there is no copy
    {
        clockid_t clock;
        timespec time{};
        if (copy_ < 0 || ::clock_getcpuclockid(copy_, &clock) != 0 || ::clock_gettime(clock, &time) != 0)
            return 0;
        return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
    }
    bool is_new() const { return files_ <= 1; } ///< it has read no other file than the last one

private:
    void start()
    {
        int there[2], back[2];
        if (::pipe2(there, O_CLOEXEC) != 0 || ::pipe2(back, O_CLOEXEC) != 0 || (copy_ = ::fork()) < 0) {
            std::perror("no copy of this process");
            std::exit(2);
        }
        if (copy_ == 0) {
            ::close(there[1]);
            take_over_handlers();
            bound_this_process();
            for (char go; ::read(there[0], &go, 1) == 1;) {
                const char outcome = char(outcome_here(file_));
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
    }

    Outcome end()
    {
        ::close(to_);
        ::close(from_);
        int status = 0;
        in_spite_of_alarms([&] { return ::waitpid(copy_, &status, 0); });
        copy_ = -1;
        if (WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF)
            return endless;
        if (WIFEXITED(status) && WEXITSTATUS(status) >= refused && WEXITSTATUS(status) < fault)
            return Outcome(WEXITSTATUS(status));
        if (status != 0)
            std::fprintf(stderr, "a copy ended with status %d\n", status);
        return fault;
    }

    fs::path file_;
    pid_t copy_ = -1;
    int to_ = -1, from_ = -1, files_ = 0;
};

/// libFuzzer's and the sanitizer's handlers would take a crash in the process that reads for users for one of this program.
class PlainSignals {
public:
    PlainSignals()
    {
        for (size_t k = 0; k < crashes.size(); ++k) {
            struct sigaction plain {};
            plain.sa_handler = SIG_DFL;
            ::sigaction(crashes[k], &plain, &before_[k]);
        }
    }
    PlainSignals(const PlainSignals&) = delete;
    PlainSignals& operator=(const PlainSignals&) = delete;
    ~PlainSignals()
    {
        for (size_t k = 0; k < crashes.size(); ++k)
            ::sigaction(crashes[k], &before_[k], nullptr);
    }

private:
    std::array<struct sigaction, crashes.size()> before_;
};

/// What became of all files. Told at the end.
struct Tally {
    long files = 0, ended = 0, again = 0, cancelled = 0, disturbed = 0;
    std::array<long, fault - refused> of{}; ///< by Outcome
    fs::path file;

    explicit Tally(const CadTarget& target)
        : file(fs::temp_directory_path() / ("spia-fuzz-" + std::to_string(::getpid()) + "." + target.name))
    {
        std::array<void*, 1> loads_the_unwinder;
        ::backtrace(loads_the_unwinder.data(), 1);
        for (const std::string& seed : target.seeds) { // what OpenCASCADE makes once, the copies have
            std::ofstream(file, std::ios::binary) << seed;
            read_and_examine(file);
        }
        __sanitizer_set_death_callback(
            [] {}); // libFuzzer's would keep every file that OpenCASCADE crashes on for users
    }
    Tally(const Tally&) = delete;
    Tally& operator=(const Tally&) = delete;
    ~Tally()
    {
        const auto count = [&](Outcome outcome) { return of[size_t(outcome - refused)]; };
        std::fprintf(
            stderr,
            "files: %ld, accepted %ld, refused %ld; OpenCASCADE crashed on %ld, needed too much memory for %ld and did not end on %ld; %ld of "
            "these were read again as users do, %ld were answered and %ld cancelled; %ld faults that a new copy did not repeat\n",
            files, count(accepted), count(refused), count(crashed), count(too_much), count(endless), again,
            again - cancelled, cancelled, disturbed);
        std::error_code gone;
        fs::remove(file, gone);
    }
};

} // namespace

void fuzz_cad(const CadTarget& target, std::string_view content)
{
    static Tally tally(target);
    static SharedCoverage coverage;
    static Reader reader(tally.file);
    std::ofstream(tally.file, std::ios::binary) << content;
    constexpr double slow = 0.04; // seconds of computing
    const double before = reader.seconds();
    Outcome outcome = reader.read();
    const bool took_long = reader.seconds() - before > slow;
    if (outcome == fault && !reader.is_new()) {
        outcome = Reader(tally.file).read();
        tally.disturbed += outcome != fault; // what OpenCASCADE had done before was the reason
    }
    if (outcome == fault)
        std::abort(); // libFuzzer keeps the file
    ++tally.files;
    ++tally.of[size_t(outcome - refused)];
    const bool ended = outcome != accepted && outcome != refused;
    if (ended || took_long) // else most of the next ones would be made from such files, and the search would crawl
        coverage.forget();
    if (!ended)
        return;
    constexpr int each = 10; // to read all of them again would take most of the time; spia-fuzz-cad does
    if (++tally.ended % each != 1)
        return;
    ++tally.again;
    const PlainSignals plain;
    tally.cancelled += !is_answered(tally.file);
}

} // namespace spia::fuzz
