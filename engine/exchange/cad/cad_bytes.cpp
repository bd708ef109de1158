#include "engine/exchange/cad/cad_bytes.h"

#include <cstring>

namespace spia {
namespace {

struct Packer {
    std::string bytes = {};
    template <class T> void row(const T& values) ///< of numbers, or of what holds only numbers
    {
        const size_t count = values.size();
        bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
        if (count > 0)
            bytes.append(reinterpret_cast<const char*>(values.data()), count * sizeof values[0]);
    }
    void row(const std::vector<std::string>& texts)
    {
        one(texts.size());
        for (const std::string& text : texts)
            row(text);
    }
    void row(const std::vector<CadItem>& items)
    {
        one(items.size());
        for (const CadItem& item : items) {
            one(item.kind);
            row(item.name);
            one(item.number);
            one(item.parent);
            one(item.faces);
        }
    }
    template <class T> void one(const T& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); }
};

struct Unpacker {
    std::string_view bytes;
    template <class T> void row(T& values)
    {
        size_t count = 0;
        one(count);
        values.resize(count);
        take(reinterpret_cast<char*>(values.data()), count * sizeof values[0]);
    }
    void row(std::vector<std::string>& texts)
    {
        size_t count = 0;
        one(count);
        texts.resize(count);
        for (std::string& text : texts)
            row(text);
    }
    void row(std::vector<CadItem>& items)
    {
        size_t count = 0;
        one(count);
        items.resize(count);
        for (CadItem& item : items) {
            one(item.kind);
            row(item.name);
            one(item.number);
            one(item.parent);
            one(item.faces);
        }
    }
    template <class T> void one(T& value) { take(reinterpret_cast<char*>(&value), sizeof value); }

private:
    void take(char* to, size_t count)
    {
        if (count > 0)
            std::memcpy(to, bytes.data(), count);
        bytes.remove_prefix(count);
    }
};

/// One list of members for both ways.
template <class Way, class Content> void all_members(Way& way, Content& cad)
{
    way.row(cad.soup.position);
    way.row(cad.soup.corner);
    way.row(cad.soup.first);
    way.row(cad.face);
    way.row(cad.normal);
    way.one(cad.faces);
    way.one(cad.taken);
    way.row(cad.tree.item);
    way.row(cad.tree.body_of);
    way.one(cad.solid);
    way.row(cad.format);
    way.row(cad.unit);
    way.one(cad.deflection);
    way.one(cad.sewing_tolerance);
    way.one(cad.half_an_edge);
    way.one(cad.shortest_edge);
    way.one(cad.free_before);
    way.one(cad.free_after);
    way.row(cad.gaps);
    way.row(cad.lost);
    way.row(cad.lost_elsewhere);
    way.row(cad.aside);
    way.row(cad.unmeshed);
    way.row(cad.slivers);
    way.one(cad.unmeshed_left_out);
    way.row(cad.doubled);
    way.row(cad.overlapping);
    way.row(cad.surface);
    way.row(cad.curves.curve);
    way.row(cad.curves.chord);
}

} // namespace

std::string packed(const CadContent& cad)
{
    Packer packer;
    all_members(packer, cad);
    return std::move(packer.bytes);
}

CadContent unpacked(std::string_view bytes)
{
    Unpacker unpacker{bytes};
    CadContent cad;
    all_members(unpacker, cad);
    return cad;
}

} // namespace spia
