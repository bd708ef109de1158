#include "engine/exchange/cad/iges_check.h"

#include <cstdio>

namespace spia {

/// The last line, letter T in column 73, counts the lines of the sections S, G, D and P.
std::string fault_of_iges(std::istream& file)
{
    int lines_of[128] = {};
    std::string line, terminate;
    while (std::getline(file, line))
        if (line.size() >= 73) {
            ++lines_of[line[72] & 127];
            if (line[72] == 'T')
                terminate = line;
        }
    int s, g, d, p;
    if (std::sscanf(terminate.c_str(), "S%7dG%7dD%7dP%7d", &s, &g, &d, &p) != 4)
        return "it is no IGES file or was cut short (the terminate section is missing)";
    if (s != lines_of[int('S')] || g != lines_of[int('G')] || d != lines_of[int('D')] || p != lines_of[int('P')])
        return "lines are missing (the terminate section counts others than there are)";
    return "";
}

} // namespace spia
