#include "engine/layout/matching.h"

#include <cstddef>
#include <queue>

namespace spia {

namespace {

/// One search for an alternating path after the other, odd cycles shrunk to their base.
class Search {
public:
    Search(const std::vector<std::vector<int>>& neighbours, std::vector<int>& partner)
        : neighbours_(neighbours), partner_(partner), parent_(partner.size()), base_(partner.size()),
          used_(partner.size()), blossom_(partner.size())
    {
    }

    bool augment(int root)
    {
        const int end = find_path(root);
        if (end < 0)
            return false;
        for (int v = end; v >= 0;) {
            const int before = parent_[std::size_t(v)], next = partner_[std::size_t(before)];
            partner_[std::size_t(v)] = before;
            partner_[std::size_t(before)] = v;
            v = next;
        }
        return true;
    }

private:
    int find_path(int root)
    {
        std::fill(used_.begin(), used_.end(), 0);
        std::fill(parent_.begin(), parent_.end(), -1);
        for (std::size_t v = 0; v < base_.size(); ++v)
            base_[v] = int(v);
        used_[std::size_t(root)] = 1;
        std::queue<int> open({root});
        while (!open.empty()) {
            const int v = open.front();
            open.pop();
            for (const int to : neighbours_[std::size_t(v)]) {
                if (base_[std::size_t(v)] == base_[std::size_t(to)] || partner_[std::size_t(v)] == to)
                    continue;
                if (to == root ||
                    (partner_[std::size_t(to)] >= 0 && parent_[std::size_t(partner_[std::size_t(to)])] >= 0))
                    shrink(v, to, open);
                else if (parent_[std::size_t(to)] < 0) {
                    parent_[std::size_t(to)] = v;
                    if (partner_[std::size_t(to)] < 0)
                        return to;
                    used_[std::size_t(partner_[std::size_t(to)])] = 1;
                    open.push(partner_[std::size_t(to)]);
                }
            }
        }
        return -1;
    }

    int common_base(int a, int b) const
    {
        std::vector<char> seen(base_.size(), 0);
        for (;;) {
            a = base_[std::size_t(a)];
            seen[std::size_t(a)] = 1;
            if (partner_[std::size_t(a)] < 0)
                break;
            a = parent_[std::size_t(partner_[std::size_t(a)])];
        }
        for (;;) {
            b = base_[std::size_t(b)];
            if (seen[std::size_t(b)])
                return b;
            b = parent_[std::size_t(partner_[std::size_t(b)])];
        }
    }

    void mark(int v, int base, int child)
    {
        while (base_[std::size_t(v)] != base) {
            const int partner = partner_[std::size_t(v)];
            blossom_[std::size_t(base_[std::size_t(v)])] = blossom_[std::size_t(base_[std::size_t(partner)])] = 1;
            parent_[std::size_t(v)] = child;
            child = partner;
            v = parent_[std::size_t(partner)];
        }
    }

    void shrink(int v, int to, std::queue<int>& open)
    {
        const int base = common_base(v, to);
        std::fill(blossom_.begin(), blossom_.end(), 0);
        mark(v, base, to);
        mark(to, base, v);
        for (std::size_t i = 0; i < base_.size(); ++i)
            if (blossom_[std::size_t(base_[i])]) {
                base_[i] = base;
                if (!used_[i]) {
                    used_[i] = 1;
                    open.push(int(i));
                }
            }
    }

    const std::vector<std::vector<int>>& neighbours_;
    std::vector<int>& partner_;
    std::vector<int> parent_, base_;
    std::vector<char> used_, blossom_;
};

} // namespace

std::vector<int> largest_matching(int nodes, const std::vector<std::array<int, 2>>& edges)
{
    std::vector<int> partner(std::size_t(nodes), -1);
    std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(nodes));
    for (const auto& [a, b] : edges) {
        neighbours[std::size_t(a)].push_back(b);
        neighbours[std::size_t(b)].push_back(a);
        if (partner[std::size_t(a)] < 0 && partner[std::size_t(b)] < 0) {
            partner[std::size_t(a)] = b;
            partner[std::size_t(b)] = a;
        }
    }
    Search search(neighbours, partner);
    for (int v = 0; v < nodes; ++v)
        if (partner[std::size_t(v)] < 0)
            search.augment(v);
    return partner;
}

} // namespace spia
