#include "engine/exchange/deck/dyna_expression.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <muParser.h>
#include <numbers>
#include <set>

#include "engine/core/read_number.h"

namespace spia {
namespace {

double truncated(double x) { return std::trunc(x); }
double nearest(double x) { return std::round(x); }
double absolute(double x) { return std::abs(x); }
double modulo(double a, double b) { return std::fmod(a, b); }
double with_sign(double a, double b) { return std::copysign(std::abs(a), b); }
double same(double x) { return x; }

void define_functions(mu::Parser& parser)
{
    parser.ClearFun();
    parser.ClearConst();
    using One = double (*)(double);
    for (const auto& [name, function] : {std::pair<const char*, One>{"abs", absolute},
                                         {"aint", truncated},
                                         {"int", truncated},
                                         {"anint", nearest},
                                         {"nint", nearest},
                                         {"real", same},
                                         {"float", same},
                                         {"sqrt", std::sqrt},
                                         {"exp", std::exp},
                                         {"log", std::log},
                                         {"log10", std::log10},
                                         {"sin", std::sin},
                                         {"cos", std::cos},
                                         {"tan", std::tan},
                                         {"asin", std::asin},
                                         {"acos", std::acos},
                                         {"atan", std::atan},
                                         {"sinh", std::sinh},
                                         {"cosh", std::cosh},
                                         {"tanh", std::tanh}})
        parser.DefineFun(name, function);
    using Two = double (*)(double, double);
    for (const auto& [name, function] :
         {std::pair<const char*, Two>{"atan2", std::atan2}, {"mod", modulo}, {"sign", with_sign}})
        parser.DefineFun(name, function);
    using Many = double (*)(const double*, int);
    parser.DefineFun("min", Many([](const double* x, int n) { return *std::min_element(x, x + n); }));
    parser.DefineFun("max", Many([](const double* x, int n) { return *std::max_element(x, x + n); }));
    parser.DefineConst("pi", std::numbers::pi);
}

/// In small letters, names without &, powers as muParser writes them, 1.d-3 as 1.e-3.
std::string as_parsed(std::string_view text)
{
    std::string result;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = char(std::tolower(static_cast<unsigned char>(text[i])));
        const bool after_number =
            i > 0 && (std::isdigit(static_cast<unsigned char>(text[i - 1])) || text[i - 1] == '.');
        if (c == '*' && i + 1 < text.size() && text[i + 1] == '*') {
            result += '^';
            ++i;
        } else if (c == 'd' && after_number && i + 1 < text.size() &&
                   (std::isdigit(static_cast<unsigned char>(text[i + 1])) || text[i + 1] == '+' || text[i + 1] == '-'))
            result += 'e';
        else if (c != '&')
            result += c;
    }
    return result;
}

std::set<std::string> names_in(const std::string& text)
{
    std::set<std::string> names;
    for (size_t i = 0; i < text.size();) {
        size_t end = i;
        while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_'))
            ++end;
        if (end > i && !std::isdigit(static_cast<unsigned char>(text[i])))
            names.insert(text.substr(i, end - i));
        i = std::max(end, i + 1);
    }
    return names;
}

} // namespace

std::optional<double> dyna_expression(std::string_view text,
                                      const std::function<std::optional<std::string>(const std::string&)>& value)
{
    constexpr size_t longest = 1000; // letters; a card has 80, and muParser's stacks grow with it
    if (text.empty() || text.size() > longest)
        return std::nullopt;
    try {
        const std::string parsed = as_parsed(text);
        mu::Parser parser;
        define_functions(parser);
        for (const std::string& name : names_in(parsed))
            if (const std::optional<std::string> known = value(name))
                if (const std::optional<double> number = read_number(*known))
                    parser.DefineConst(name, *number);
        parser.SetExpr(parsed);
        const double result = parser.Eval();
        return std::isfinite(result) ? std::optional(result) : std::nullopt;
    } catch (const mu::ParserError&) {
        return std::nullopt;
    }
}

} // namespace spia
