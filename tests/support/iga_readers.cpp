#include "tests/support/iga_readers.h"

#include <array>
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace spia::iga {
namespace {

void require(bool sound, const std::string& what)
{
    if (!sound)
        throw std::runtime_error(what);
}

std::string text_of(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    require(stream.good(), "no file " + file.string());
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// Words one after the other.
class Words {
public:
    explicit Words(const std::string& text) : stream_(text) {}

    std::string word()
    {
        std::string result;
        require(bool(stream_ >> result), "the text ends too early");
        return result;
    }
    void expect(const std::string& wanted)
    {
        const std::string found = word();
        require(found == wanted, "wanted " + wanted + ", found " + found);
    }
    double number()
    {
        const std::string digits = word();
        char* end = nullptr;
        const double value = std::strtod(digits.c_str(), &end);
        require(*end == 0, digits + " is no number");
        return value;
    }
    int integer() { return int(number()); }
    std::vector<double> numbers(int count)
    {
        std::vector<double> result;
        for (int i = 0; i < count; ++i)
            result.push_back(number());
        return result;
    }
    bool at_end() { return (stream_ >> std::ws).eof(); }

private:
    std::istringstream stream_;
};

std::vector<double> numbers_in(const std::string& text)
{
    Words words(text);
    std::vector<double> result;
    while (!words.at_end())
        result.push_back(words.number());
    return result;
}

std::string without_comments(const std::string& text)
{
    std::istringstream lines(text);
    std::string result;
    for (std::string line; std::getline(lines, line);)
        result += line.substr(0, line.find('#')) + "\n";
    return result;
}

/// G+Smo and GeoPDEs count u = 0, u = 1, v = 0, v = 1.
Side west_east_south_north(int number)
{
    require(number >= 1 && number <= 4, "no side");
    return std::array{Side::u0, Side::u1, Side::v0, Side::v1}[size_t(number - 1)];
}

NurbsSurface surface(int p, int q, std::vector<double> u, std::vector<double> v)
{
    NurbsSurface s;
    s.degree_u = p;
    s.degree_v = q;
    s.count_u = int(u.size()) - p - 1;
    s.count_v = int(v.size()) - q - 1;
    s.knots_u = std::move(u);
    s.knots_v = std::move(v);
    require(s.count_u > p && s.count_v > q, "too few knots");
    s.weight.setOnes(s.count_u * s.count_v);
    return s;
}

} // namespace

Content read_gismo(const std::filesystem::path& file)
{
    namespace pt = boost::property_tree;
    pt::ptree tree;
    pt::read_xml(file.string(), tree);
    const pt::ptree& root = tree.get_child("xml");
    Content content;
    std::map<int, int> patch_of; // id
    const pt::ptree* multi = nullptr;
    for (const auto& [tag, node] : root) {
        if (tag == "MultiPatch")
            multi = &node;
        if (tag != "Geometry")
            continue;
        const auto type = node.get<std::string>("<xmlattr>.type");
        require(type == "TensorBSpline2" || type == "TensorNurbs2", "type " + type);
        const bool rational = type == "TensorNurbs2";
        const pt::ptree* basis = &node.get_child("Basis");
        const pt::ptree& outer_basis = *basis;
        if (rational) {
            require(basis->get<std::string>("<xmlattr>.type") == "TensorNurbsBasis2", "rational basis");
            basis = &basis->get_child("Basis");
        }
        require(basis->get<std::string>("<xmlattr>.type") == "TensorBSplineBasis2", "tensor basis");
        std::vector<std::vector<double>> knots;
        std::vector<int> degree;
        for (const auto& [name, component] : *basis)
            if (name == "Basis") {
                require(component.get<std::string>("<xmlattr>.type") == "BSplineBasis", "component");
                require(component.get<int>("<xmlattr>.index") == int(knots.size()), "index");
                knots.push_back(numbers_in(component.get<std::string>("KnotVector")));
                degree.push_back(component.get<int>("KnotVector.<xmlattr>.degree"));
            }
        require(knots.size() == 2, "two directions");
        NurbsSurface s = surface(degree[0], degree[1], knots[0], knots[1]);
        const int count = s.count_u * s.count_v;
        if (rational) {
            const std::vector<double> weights = numbers_in(outer_basis.get<std::string>("weights"));
            require(int(weights.size()) == count, "weights");
            s.weight = Eigen::Map<const Eigen::VectorXd>(weights.data(), count);
        }
        const int dimension = node.get<int>("coefs.<xmlattr>.geoDim");
        const std::vector<double> coefs = numbers_in(node.get<std::string>("coefs"));
        require(int(coefs.size()) == dimension * count, "coefs");
        if (dimension == 1)
            content.values.push_back(Eigen::Map<const Eigen::VectorXd>(coefs.data(), count));
        else
            s.control = Eigen::Map<const Eigen::Matrix3Xd>(coefs.data(), 3, count);
        patch_of[node.get<int>("<xmlattr>.id")] = int(content.patches.patch.size());
        content.patches.patch.push_back(s);
    }
    require(multi, "no MultiPatch");
    require(multi->get<int>("<xmlattr>.parDim") == 2, "parDim");
    require(multi->get<std::string>("patches.<xmlattr>.type") == "id_range", "range");
    Words range(multi->get<std::string>("patches"));
    const int first = range.integer(), last = range.integer();
    require(last - first + 1 == int(content.patches.patch.size()), "patches of the range");
    Words interfaces(multi->get<std::string>("interfaces", ""));
    while (!interfaces.at_end()) {
        std::array<int, 8> n;
        for (int& each : n)
            each = interfaces.integer();
        const PatchSide a{patch_of.at(n[0]), west_east_south_north(n[1])},
            b{patch_of.at(n[2]), west_east_south_north(n[3])};
        const int across_a = n[1] > 2, across_b = n[3] > 2; // 0: u
        require(n[size_t(4 + across_a)] == across_b && n[size_t(5 - across_a)] == 1 - across_b, "direction map");
        // Going out of the first patch is going into the second.
        require(n[size_t(6 + across_a)] == int((n[1] - 1) % 2 != (n[3] - 1) % 2), "sense across");
        content.patches.interfaces.push_back({a, b, n[size_t(7 - across_a)] == 0});
    }
    Words boundary(multi->get<std::string>("boundary", ""));
    while (!boundary.at_end()) {
        const int patch = patch_of.at(boundary.integer());
        content.outer.push_back({patch, west_east_south_north(boundary.integer())});
    }
    return content;
}

Content read_geopdes(const std::filesystem::path& file)
{
    const std::string text = text_of(file);
    require(text.rfind("# nurbs mesh v.2.1\n", 0) == 0, "version");
    Words words(without_comments(text));
    require(words.integer() == 2 && words.integer() == 3, "dimensions");
    const int patches = words.integer(), interfaces = words.integer();
    require(words.integer() == 0, "subdomains");
    Content content;
    for (int p = 0; p < patches; ++p) {
        words.expect("PATCH");
        require(words.integer() == p + 1, "patch number");
        const int du = words.integer(), dv = words.integer(), nu = words.integer(), nv = words.integer();
        std::vector<double> u = words.numbers(nu + du + 1), v = words.numbers(nv + dv + 1);
        NurbsSurface s = surface(du, dv, std::move(u), std::move(v));
        Eigen::Matrix4Xd points(4, nu * nv);
        for (int k = 0; k < 4; ++k)
            for (int c = 0; c < nu * nv; ++c)
                points(k, c) = words.number();
        s.weight = points.row(3);
        s.control = points.topRows<3>().array().rowwise() / points.row(3).array();
        content.patches.patch.push_back(s);
        content.points.push_back(points);
    }
    const auto side = [&] {
        const int patch = words.integer() - 1;
        return PatchSide{patch, west_east_south_north(words.integer())};
    };
    for (int i = 0; i < interfaces; ++i) {
        words.expect("INTERFACE");
        require(words.integer() == i + 1, "interface number");
        const PatchSide a = side(), b = side();
        const int sense = words.integer();
        require(sense == 1 || sense == -1, "sense");
        content.patches.interfaces.push_back({a, b, sense == -1});
    }
    while (!words.at_end()) {
        words.expect("BOUNDARY");
        words.integer();
        for (int n = words.integer(); n > 0; --n)
            content.outer.push_back(side());
    }
    return content;
}

Content read_mfem(const std::filesystem::path& file)
{
    const std::string text = text_of(file);
    require(text.rfind("MFEM NURBS mesh v1.0\n", 0) == 0, "version");
    Words words(without_comments(text.substr(text.find('\n'))));
    words.expect("dimension");
    require(words.integer() == 2, "dimension");
    words.expect("elements");
    std::vector<std::array<int, 4>> corner(size_t(words.integer()));
    for (size_t p = 0; p < corner.size(); ++p) {
        require(words.integer() == int(p) + 1 && words.integer() == 3, "element");
        for (int& c : corner[p])
            c = words.integer();
    }
    words.expect("boundary");
    std::vector<std::array<int, 2>> boundary(size_t(words.integer()));
    for (auto& [a, b] : boundary) {
        words.integer();
        require(words.integer() == 1, "segment");
        a = words.integer();
        b = words.integer();
    }
    words.expect("edges");
    struct Edge {
        int number, knots, from, to;
    };
    std::map<std::pair<int, int>, Edge> edges;
    const int edge_count = words.integer();
    for (int e = 0; e < edge_count; ++e) {
        const int knots = words.integer(), from = words.integer(), to = words.integer();
        require(edges.emplace(std::minmax(from, to), Edge{e, knots, from, to}).second, "an edge twice");
    }
    words.expect("vertices");
    const int vertices = words.integer();
    words.expect("patches");
    Content content;
    std::map<int, std::vector<double>> knots_of;
    std::map<int, std::pair<PatchSide, int>> side_of_edge; // with the corner at which the side
                                                           // begins
    for (size_t p = 0; p < corner.size(); ++p) {
        words.expect("knotvectors");
        require(words.integer() == 2, "two knot vectors");
        std::array<std::vector<double>, 2> knots;
        std::array<int, 2> degree, count;
        for (size_t d = 0; d < 2; ++d) {
            degree[d] = words.integer();
            count[d] = words.integer();
            knots[d] = words.numbers(count[d] + degree[d] + 1);
        }
        words.expect("dimension");
        require(words.integer() == 3, "space");
        words.expect("controlpoints_cartesian");
        NurbsSurface s = surface(degree[0], degree[1], knots[0], knots[1]);
        Eigen::Matrix4Xd points(4, count[0] * count[1]);
        for (int c = 0; c < points.cols(); ++c)
            for (int k = 0; k < 4; ++k)
                points(k, c) = words.number();
        s.control = points.topRows<3>();
        s.weight = points.row(3);
        content.patches.patch.push_back(s);
        content.points.push_back(points);
        const std::array<int, 4>& c = corner[p];
        for (const int each : c)
            require(each >= 0 && each < vertices, "corner");
        const std::array<std::pair<int, int>, 4> ends{{{c[0], c[1]}, {c[1], c[2]}, {c[3], c[2]}, {c[0], c[3]}}};
        for (const Side side : sides) { // the knot vector of an edge is that of the patch, turned
                                        // if the edge runs the other way
            const auto [from, to] = ends[size_t(side)];
            const Edge edge = edges.at(std::minmax(from, to));
            std::vector<double> along = knots[side == Side::v0 || side == Side::v1 ? 0 : 1];
            if (edge.from != from)
                for (size_t k = 0, n = along.size(); k < (n + 1) / 2; ++k)
                    std::tie(along[k], along[n - 1 - k]) = std::pair(1 - along[n - 1 - k], 1 - along[k]);
            const std::vector<double>& known = knots_of.emplace(edge.knots, along).first->second;
            require(known.size() == along.size(), "knots of a strip");
            for (size_t k = 0; k < along.size(); ++k)
                require(std::abs(along[k] - known[k]) < 1e-15, "knots of a strip");
            const auto [other, first] = side_of_edge.emplace(edge.number, std::pair(PatchSide{int(p), side}, from));
            if (!first)
                content.patches.interfaces.push_back(
                    {other->second.first, {int(p), side}, other->second.second != from});
        }
    }
    require(words.at_end(), "more than the patches");
    for (const auto& [a, b] : boundary) {
        const PatchSide side = side_of_edge.at(edges.at(std::minmax(a, b)).number).first;
        const size_t k = size_t(side.side); // counter-clockwise
        require(corner[size_t(side.patch)][k] == a && corner[size_t(side.patch)][(k + 1) % 4] == b,
                "sense of the boundary");
        content.outer.push_back(side);
    }
    return content;
}

std::vector<Eigen::VectorXd> read_mfem_field(const std::filesystem::path& file, const MultiPatch& patches)
{
    Words words(without_comments(text_of(file)));
    for (const char* each :
         {"FiniteElementSpace", "FiniteElementCollection:", "NURBS", "VDim:", "1", "Ordering:", "0", "NURBS_patches"})
        words.expect(each);
    std::vector<Eigen::VectorXd> result;
    for (const NurbsSurface& patch : patches.patch) {
        const std::vector<double> values = words.numbers(patch.count_u * patch.count_v);
        result.push_back(Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(values.size())));
    }
    require(words.at_end(), "more values");
    return result;
}

Content read_dyna(const std::filesystem::path& file)
{
    std::istringstream stream(text_of(file));
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
        if (line.empty() || line[0] != '$')
            lines.push_back(line);
    size_t at = 0;
    const auto line = [&]() -> const std::string& {
        require(at < lines.size(), "the deck ends too early");
        return lines[at++];
    };
    const auto field = [](const std::string& text, int width, int k) {
        require(int(text.size()) >= width * (k + 1), "a short card: " + text);
        return numbers_in(text.substr(size_t(width * k), size_t(width))).at(0);
    };
    const auto values = [&](int count) {
        std::vector<double> result;
        while (int(result.size()) < count) {
            const std::string& card = line();
            for (int k = 0; k < 4 && int(result.size()) < count; ++k)
                result.push_back(field(card, 20, k));
        }
        return result;
    };
    Content content;
    std::vector<int> section_of_part, part_of_shell, patch_of_face;
    std::map<int, double> thickness;
    bool elastic = false;
    require(line() == "*KEYWORD", "*KEYWORD");
    for (std::string keyword = line(); keyword != "*END"; keyword = line()) {
        if (keyword == "*IGA_2D_NURBS_XYZ") {
            const std::string card = line();
            require(field(card, 10, 0) == double(content.patches.patch.size() + 1), "patch id");
            const int nr = int(field(card, 10, 1)), ns = int(field(card, 10, 2)), pr = int(field(card, 10, 3)),
                      ps = int(field(card, 10, 4));
            const std::string uniform = line();
            require(field(uniform, 10, 0) == 0 && field(uniform, 10, 1) == 0, "knots follow");
            std::vector<double> u = values(nr + pr + 1), v = values(ns + ps + 1);
            NurbsSurface s = surface(pr, ps, std::move(u), std::move(v));
            s.control.resize(3, nr * ns);
            for (int c = 0; c < nr * ns; ++c) {
                const std::vector<double> point = values(4);
                s.control.col(c) << point[0], point[1], point[2];
                s.weight[c] = point[3];
            }
            content.patches.patch.push_back(s);
        } else if (keyword == "*IGA_FACE_XYZ") {
            const std::string card = line();
            require(field(card, 10, 2) == 0, "orientation");
            patch_of_face.push_back(int(field(card, 10, 1)));
        } else if (keyword == "*IGA_SHELL")
            part_of_shell.push_back(int(field(line(), 10, 1)));
        else if (keyword == "*PART") {
            line();
            section_of_part.push_back(int(field(line(), 10, 1)));
        } else if (keyword == "*SECTION_IGA_SHELL") {
            const int id = int(field(line(), 10, 0));
            thickness[id] = field(line(), 10, 0);
        } else {
            require(keyword == "*MAT_ELASTIC", "keyword " + keyword);
            const std::string card = line();
            elastic = field(card, 10, 1) > 0 && field(card, 10, 2) > 0;
        }
    }
    require(elastic, "material");
    for (size_t p = 0; p < content.patches.patch.size(); ++p) {
        require(patch_of_face.at(p) == int(p) + 1, "face");
        content.thickness.push_back(thickness.at(section_of_part.at(size_t(part_of_shell.at(p) - 1))));
    }
    return content;
}

} // namespace spia::iga
