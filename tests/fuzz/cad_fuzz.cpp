#include "tests/fuzz/cad_fuzz.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <execinfo.h>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <new>
#include <sanitizer/asan_interface.h>
#include <set>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

#include "tests/fuzz/cad_copy.h"
#include "tests/fuzz/cad_search.h"
#include "tests/fuzz/crash_owner.h"

/// The counters of this program's branches, which libFuzzer looks at; the linker names their begin and end.
extern "C" __attribute__((visibility("hidden"))) std::uint8_t __start___sancov_cntrs[], __stop___sancov_cntrs[];

namespace spia::fuzz {
namespace {

namespace fs = std::filesystem;

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

/// libFuzzer's and the sanitizer's handlers would take a crash in the process that reads for users for one of this program.
class PlainSignals {
public:
    PlainSignals()
    {
        for (size_t k = 0; k < signals.size(); ++k) {
            struct sigaction plain {};
            plain.sa_handler = SIG_DFL;
            ::sigaction(signals[k], &plain, &before_[k]);
        }
    }
    PlainSignals(const PlainSignals&) = delete;
    PlainSignals& operator=(const PlainSignals&) = delete;
    ~PlainSignals()
    {
        for (size_t k = 0; k < signals.size(); ++k)
            ::sigaction(signals[k], &before_[k], nullptr);
    }

private:
    static constexpr std::array signals = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
    std::array<struct sigaction, signals.size()> before_;
};

pid_t this_process = 0;

class Search {
public:
    explicit Search(const CadTarget& target)
        : file_(fs::temp_directory_path() / fmt::format("spia-fuzz-{}.{}", ::getpid(), target.name)),
          folder_(std::getenv("SPIA_FUZZ_ENDED") ? std::getenv("SPIA_FUZZ_ENDED") : ""), copy_(file_)
    {
        ::signal(SIGPIPE, SIG_IGN); // a copy may be gone before it is asked
        std::array<void*, 1> loads_the_unwinder;
        ::backtrace(loads_the_unwinder.data(), 1);
        this_process = ::getpid();
        __sanitizer_set_death_callback(
            [] { // of this process for libFuzzer to keep the file, not of those that read for users
                if (::getpid() == this_process)
                    std::abort();
            });
        std::string wrong(fault_of_owners());
        for (const std::string& seed : target.seeds) { // what OpenCASCADE makes once, the copies have
            put(seed);
            if (!read_and_examine(file_) || CadCopy(file_).read() != accepted)
                wrong = "a seed is not accepted: " + seed;
        }
        if (!wrong.empty()) {
            std::fprintf(stderr, "the search proves nothing: %s\n", wrong.c_str());
            std::exit(2);
        }
    }
    Search(const Search&) = delete;
    Search& operator=(const Search&) = delete;
    ~Search()
    {
        print();
        remove_file();
    }

    void read(std::string_view content)
    {
        put(content);
        const double before = copy_.seconds();
        Outcome outcome = copy_.read();
        const bool slow = !copy_.is_new() && copy_.seconds() - before > 0.04; // computing
        if (outcome == fault)
            outcome = of_a_new_copy();
        ++of_[size_t(outcome - refused)];
        const bool ended = outcome != accepted && outcome != refused;
        if (ended) {
            keep(copy_.place());
            constexpr int each = 10; // to read all of them again would take most of the time; spia-fuzz-cad does
            if (++ended_ % each == 1)
                read_as_users_do();
        }
        if (ended || slow) // else most of the next ones would be made from such files, and the search would crawl
            coverage_.forget();
        constexpr long often = 100'000;
        if (++files_ % often == 0)
            print();
    }

private:
    void put(std::string_view content) { std::ofstream(file_, std::ios::binary) << content; }

    void remove_file()
    {
        std::error_code gone;
        fs::remove(file_, gone);
    }

    [[noreturn]] void give_up()
    {
        print();
        remove_file();
        std::abort(); // libFuzzer keeps the file
    }

    /// What OpenCASCADE had done before may be the reason.
    Outcome of_a_new_copy()
    {
        const bool was_new = copy_.is_new();
        copy_.end();
        const Outcome again = was_new ? fault : CadCopy(file_).read();
        if (again == fault)
            give_up();
        save(fmt::format("disturbed-{}", ++disturbed_));
        return again;
    }

    void read_as_users_do()
    {
        std::string wrong;
        try {
            const PlainSignals plain;
            ++again_;
            cancelled_ += !is_answered(file_);
        } catch (const std::exception& fault) {
            wrong = fault.what();
        }
        if (wrong.empty())
            return;
        std::fprintf(stderr, "read as users do: %s\n", wrong.c_str());
        give_up();
    }

    void keep(const std::string& place)
    {
        constexpr size_t most = 500;
        if (places_.size() < most && places_.insert(place).second)
            save(place);
    }

    void save(const std::string& name)
    {
        std::error_code failed;
        if (!folder_.empty())
            fs::copy_file(file_, folder_ / (name + file_.extension().string()), failed);
    }

    void print() const
    {
        const auto count = [&](Outcome outcome) { return of_[size_t(outcome - refused)]; };
        std::fprintf(
            stderr,
            "files: %ld, accepted %ld, refused %ld; OpenCASCADE crashed on %ld, needed too much memory for %ld "
            "and did not end on %ld, at %zu places; %ld of these were read again as users do, %ld answered and "
            "%ld cancelled; %ld faults that a new copy did not repeat\n",
            files_, count(accepted), count(refused), count(crashed), count(too_much), count(endless), places_.size(),
            again_, again_ - cancelled_, cancelled_, disturbed_);
    }

    fs::path file_, folder_;
    SharedCoverage coverage_;
    CadCopy copy_;
    long files_ = 0, ended_ = 0, again_ = 0, cancelled_ = 0, disturbed_ = 0;
    std::array<long, fault - refused> of_{}; ///< by Outcome
    std::set<std::string> places_;
};

} // namespace

void fuzz_cad(const CadTarget& target, std::string_view content)
{
    static Search search(target);
    search.read(content);
}

} // namespace spia::fuzz
