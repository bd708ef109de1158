#include "engine/forming/material/tensile_test.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/mesh/doctor/doctor.h"
#include "engine/options/sheet_options.h"

namespace spia {
namespace {

constexpr double proof_strain = 0.002; // of Rp0.2; below it yielding is not complete
constexpr size_t fewest_rows = 8;

/// The rows as engineering strain (a fraction) and stress.
struct Rows {
    std::vector<double> strain, stress;
    std::vector<long> line;
    size_t size() const { return strain.size(); }
};

struct Line {
    double slope, foot; ///< MPa; the strain where the stress is zero
};

class TestReader {
public:
    TestReader(const TwoColumns& table, const std::string& name, const TensileOptions& options)
        : table_(table), name_(name), options_(options)
    {
    }

    TensileTest test()
    {
        require_MPa();
        const Rows all = rising(engineering_rows());
        const size_t neck = greatest_force(all);
        const std::optional<Line> elastic = elastic_line(all, neck);
        out_.measured_young = !options_.young_MPa && elastic;
        if (!elastic && !options_.young_MPa)
            fail(fmt::format("the rows hold no straight elastic part (five rows between 10 and 50 % of the yield "
                             "stress); give Young's modulus ({})",
                             mention(option::young)));
        out_.young_MPa = options_.young_MPa ? *options_.young_MPa : elastic->slope;
        constexpr double least_MPa = 2e4, greatest_MPa = 5e5; // lead 16000, tungsten 400000
        if (!(out_.young_MPa > least_MPa && out_.young_MPa < greatest_MPa))
            fail(fmt::format("Young's modulus is {:.4g} MPa; no sheet has that. Is the strain that of the machine? "
                             "Give the modulus ({})",
                             out_.young_MPa, mention(option::young)));
        cut(all, neck, elastic ? *elastic : Line{out_.young_MPa, 0});
        return std::move(out_);
    }

private:
    [[noreturn]] void fail(const std::string& what) const { throw InputError(fmt::format("{}: {}", name_, what)); }
    [[noreturn]] void fail(long line, const std::string& what) const
    {
        throw InputError(fmt::format("{}, line {}: {}", name_, line, what));
    }

    void require_MPa() const
    {
        for (const char* unit : {"gpa", "kpa", "pa", "psi", "ksi", "kn", "[n]", "(n)", "force"})
            if (table_.titles_have(unit))
                fail(fmt::format("the heading says \"{}\"; give the stress in MPa (N/mm2)", unit));
    }

    bool stress_first() const
    {
        const auto names = [](const std::string& title, std::initializer_list<const char*> words) {
            return std::any_of(words.begin(), words.end(),
                               [&](const char* word) { return title.find(word) != title.npos; });
        };
        if (table_.column_title.empty())
            return false;
        const auto stress = {"stress", "spannung", "mpa", "n/mm"};
        const auto strain = {"strain", "dehnung", "elongation", "%"};
        return names(table_.column_title[0], stress) && names(table_.column_title[1], strain);
    }

    bool is_true() const
    {
        if (options_.kind)
            return *options_.kind == TensileOptions::Kind::truly;
        const bool truly = table_.heading_has("true") || table_.heading_has("logarithmic"),
                   engineering = table_.heading_has("engineering") || table_.heading_has("nominal");
        if (truly == engineering)
            fail(fmt::format("the heading {}; choose ({})",
                             truly ? "says both true and engineering"
                                   : "does not say whether stress and strain are engineering or true",
                             mention(option::stress_measure, "engineering|true")));
        return truly;
    }

    bool in_percent(const std::vector<double>& strain)
    {
        if (options_.in_percent)
            return *options_.in_percent;
        if (table_.titles_have("%") || table_.titles_have("percent"))
            return true;
        constexpr double most = 2; // no sheet stretches to three times its length
        const bool large = *std::max_element(strain.begin(), strain.end()) > most;
        if (large)
            out_.notes.push_back("strains above 2 were taken as percent");
        return large;
    }

    Rows engineering_rows()
    {
        const bool swapped = stress_first(), truly = is_true();
        Rows rows{swapped ? table_.second : table_.first, swapped ? table_.first : table_.second, table_.line};
        const double unit = in_percent(rows.strain) ? 0.01 : 1;
        for (size_t i = 0; i < rows.size(); ++i) {
            double& e = rows.strain[i];
            double& s = rows.stress[i];
            e *= unit;
            if (!(e > -0.05 && e < 5))
                fail(rows.line[i], fmt::format("the strain {:.4g} cannot be one of a tensile test", e));
            if (!(std::abs(s) < 1e4))
                fail(rows.line[i], fmt::format("the stress {:.4g} is beyond every sheet; give it in MPa", s));
            if (truly) {
                s /= std::exp(e);
                e = std::expm1(e);
            }
        }
        if (*std::max_element(rows.stress.begin(), rows.stress.end()) < 5)
            fail("no stress reaches 5 MPa; give it in MPa (N/mm2)");
        return rows;
    }

    /// Rows whose strain exceeds all before: extensometers shiver. A test that goes back is
    /// something else.
    Rows rising(const Rows& rows)
    {
        Rows kept;
        long first_fall = 0;
        for (size_t i = 0; i < rows.size(); ++i) {
            if (kept.size() > 0 && rows.strain[i] <= kept.strain.back()) {
                first_fall = first_fall ? first_fall : rows.line[i];
                continue;
            }
            kept.strain.push_back(rows.strain[i]);
            kept.stress.push_back(rows.stress[i]);
            kept.line.push_back(rows.line[i]);
        }
        const size_t left_out = rows.size() - kept.size();
        if (2 * left_out > rows.size())
            fail(first_fall,
                 "the strain falls here, and in more than half of the rows; give one loading up to fracture");
        if (left_out > 0)
            out_.notes.push_back(fmt::format(
                "{} left out, the first in line {}",
                counted(left_out, "row whose strain does not rise was", "rows whose strain does not rise were"),
                first_fall));
        if (kept.size() < fewest_rows)
            fail(fmt::format("{} rows of rising strain are too few for a fit; give at least {}", kept.size(),
                             fewest_rows));
        return kept;
    }

    /// The row of the greatest force, of a running mean so that noise on its flat top does not
    /// choose.
    size_t greatest_force(const Rows& rows)
    {
        const size_t half = rows.size() / 100;
        size_t best = 0;
        double greatest = -1;
        for (size_t i = 0; i < rows.size(); ++i) {
            const size_t from = i > half ? i - half : 0, to = std::min(i + half, rows.size() - 1);
            double sum = 0;
            for (size_t k = from; k <= to; ++k)
                sum += rows.stress[k];
            if (sum / double(to - from + 1) > greatest) {
                greatest = sum / double(to - from + 1);
                best = i;
            }
        }
        if (best + 1 + half >= rows.size()) {
            best = rows.size() - 1;
            out_.notes.push_back("the data end before the force falls: the sheet may strain further before it necks");
        } else
            out_.notes.push_back(
                fmt::format("cut at the greatest force, line {}: beyond it the bar necks", rows.line[best]));
        out_.tensile_strength_MPa = greatest;
        return best;
    }

    /// A line through the first rows between two stresses; none unless five rows lie on it.
    static std::optional<Line> line_between(const Rows& rows, size_t end, double low, double high)
    {
        std::vector<size_t> used;
        for (size_t i = 0; i < end && rows.stress[i] <= high; ++i)
            if (rows.stress[i] >= low)
                used.push_back(i);
        if (used.size() < 5)
            return {};
        double e = 0, s = 0, ee = 0, es = 0, ss = 0;
        for (const size_t i : used) {
            e += rows.strain[i] / double(used.size());
            s += rows.stress[i] / double(used.size());
        }
        for (const size_t i : used) {
            const double x = rows.strain[i] - e, y = rows.stress[i] - s;
            ee += x * x;
            es += x * y;
            ss += y * y;
        }
        constexpr double straight = 0.98; // squared correlation
        if (!(es * es >= straight * ee * ss) || !(es > 0))
            return {};
        return Line{es / ee, e - s * ee / es};
    }

    /// Engineering stress where the curve leaves the line by 0.2 % of strain; the last one if it
    /// does not.
    static double proof_stress(const Rows& rows, size_t neck, const Line& line)
    {
        for (size_t i = 0; i <= neck; ++i)
            if (rows.strain[i] - line.foot - rows.stress[i] / line.slope > proof_strain)
                return rows.stress[i];
        return rows.stress[neck];
    }

    static std::optional<Line> elastic_line(const Rows& rows, size_t neck)
    {
        for (const double share : {0.5, 0.25, 0.12}) { // of the strength: a first guess of the
                                                       // yield stress
            double proof = share * rows.stress[neck];
            std::optional<Line> line;
            for (int pass = 0; pass < 4; ++pass) {
                const auto better = line_between(rows, neck, 0.1 * proof, 0.5 * proof);
                if (!better)
                    break;
                line = better;
                proof = proof_stress(rows, neck, *line);
            }
            if (line)
                return line;
        }
        return {};
    }

    /// Where a modulus was given, what the line is softer than it is the machine's compliance, and
    /// taken off.
    void cut(const Rows& rows, size_t neck, const Line& elastic)
    {
        out_.proof_stress_MPa = proof_stress(rows, neck, elastic);
        std::vector<double> strain, stress;
        for (size_t i = 0; i <= neck; ++i) {
            const double of_machine = rows.stress[i] * (1 / elastic.slope - 1 / out_.young_MPa);
            const double e = rows.strain[i] - elastic.foot - of_machine, sigma = rows.stress[i] * (1 + e);
            const double plastic = std::log1p(e) - sigma / out_.young_MPa;
            if (i == neck)
                out_.uniform_strain = std::log1p(e);
            if (plastic >= proof_strain && sigma > 0) {
                strain.push_back(plastic);
                stress.push_back(sigma);
            }
        }
        if (strain.size() < fewest_rows)
            fail(rows.line[neck],
                 fmt::format("the force is greatest here, and only {} rows between a plastic strain of "
                             "0.002 and here can be fitted; {} are needed",
                             strain.size(), fewest_rows));
        out_.plastic_strain = Eigen::Map<Eigen::VectorXd>(strain.data(), Eigen::Index(strain.size()));
        out_.stress_MPa = Eigen::Map<Eigen::VectorXd>(stress.data(), Eigen::Index(stress.size()));
    }

    const TwoColumns& table_;
    const std::string& name_;
    const TensileOptions& options_;
    TensileTest out_;
};

} // namespace

TensileTest tensile_test(const TwoColumns& table, const std::string& name, const TensileOptions& options)
{
    return TestReader(table, name, options).test();
}

} // namespace spia
