#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "materials/measured/matrix_table.h"
#include "materials/measured/measured_table.h"
#include "materials/measured/tree_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <pugixml.hpp>

namespace lightwell {
namespace {

class Reader {
public:
    Reader(std::string_view xml, const std::string& file) : xml_(xml), file_(file)
    {
        const pugi::xml_parse_result parsed = document_.load_buffer(xml.data(), xml.size());
        if (!parsed)
            throw InputError{at(parsed.offset), std::string("no XML: ") + parsed.description(),
                             "the file is damaged, or no file of scattering data"};
    }
    std::shared_ptr<const MeasuredTable> table()
    {
        const pugi::xml_node layer = child(child(document_.child("WindowElement"), "Optical"), "Layer");
        if (!layer)
            throw InputError{file_, "no WindowElement with Optical and Layer",
                             "give XML as WINDOW or genBSDF write it"};
        about(layer);
        read_bases(layer);
        for (const pugi::xml_node data : layer.children("WavelengthData"))
            wavelength(data);
        for (const Target& target : targets())
            if ((target.beside->x == nullptr) != (target.beside->z == nullptr) || *target.part == nullptr)
                *target.beside = {}; // one alone is no colour
        if (parts_.front == nullptr && parts_.back == nullptr && parts_.from_front == nullptr &&
            parts_.from_back == nullptr)
            throw InputError{file_,
                             about_.not_read.empty() ? "no scattering data"
                                                     : "no data for visible light, only for " + about_.not_read,
                             "the file needs WavelengthData whose Wavelength is Visible"};
        return std::make_shared<const MeasuredTable>(std::move(parts_), std::move(about_));
    }

private:
    static pugi::xml_node child(const pugi::xml_node& node, const char* name) { return node.child(name); }
    static std::string text_of(const pugi::xml_node& node, const char* name)
    {
        return std::string(trimmed(node.child(name).text().get()));
    }
    /// File and line of a byte.
    std::string at(std::ptrdiff_t offset) const
    {
        const auto end = std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, offset)), xml_.size());
        const auto lines = std::count(xml_.begin(), xml_.begin() + static_cast<std::ptrdiff_t>(end), '\n');
        return file_ + ':' + std::to_string(lines + 1);
    }
    std::string at(const pugi::xml_node& node) const { return at(node.offset_debug()); }

    double length_m(const pugi::xml_node& material, const char* name) const
    {
        const pugi::xml_node node = material.child(name);
        const auto value = parse_double(trimmed(node.text().get()));
        if (!node || !value)
            return 0;
        const std::string unit = lowercase_ascii(node.attribute("unit").as_string("meter"));
        constexpr std::pair<std::string_view, double> units[] = {
            {"meter", 1},         {"m", 1},     {"metre", 1},     {"millimeter", 1e-3}, {"mm", 1e-3},
            {"centimeter", 1e-2}, {"cm", 1e-2}, {"inch", 0.0254}, {"foot", 0.3048}};
        for (const auto& [word, metres] : units)
            if (unit == word && *value >= 0 && std::isfinite(*value))
                return *value * metres;
        throw InputError{at(node), std::string(name) + " is " + std::string(trimmed(node.text().get())) + ' ' + unit,
                         "expected a length >= 0 in meter, centimeter, millimeter, inch or foot"};
    }
    void about(const pugi::xml_node& layer)
    {
        const pugi::xml_node material = layer.child("Material");
        about_.name = text_of(material, "Name");
        about_.manufacturer = text_of(material, "Manufacturer");
        about_.thickness_m = length_m(material, "Thickness");
        about_.width_m = length_m(material, "Width");
        about_.height_m = length_m(material, "Height");
        const pugi::xml_node geometry = layer.child("Geometry");
        about_.geometry_format = geometry.attribute("format").as_string();
        for (const pugi::xml_node block : geometry.children("MGFblock"))
            about_.geometry += std::string(block.attribute("unit").as_string("meter")) + '\n' + block.text().get();
        if (about_.geometry.empty())
            about_.geometry = std::string(trimmed(geometry.text().get()));
        structure_ = text_of(layer.child("DataDefinition"), "IncidentDataStructure");
    }
    void read_bases(const pugi::xml_node& layer)
    {
        for (const pugi::xml_node basis : layer.child("DataDefinition").children("AngleBasis")) {
            std::vector<AngleBasis::Ring> rings;
            for (const pugi::xml_node block : basis.children("AngleBasisBlock")) {
                const pugi::xml_node bounds = block.child("ThetaBounds");
                rings.push_back({bounds.child("LowerTheta").text().as_double(-1),
                                 bounds.child("UpperTheta").text().as_double(-1),
                                 block.child("nPhis").text().as_int()});
            }
            const std::string name = text_of(basis, "AngleBasisName");
            bases_.emplace_back(name, std::move(rings), at(basis));
        }
    }
    const AngleBasis& basis(const pugi::xml_node& block, const char* kind) const
    {
        const std::string name = text_of(block, kind);
        const auto own =
            std::find_if(bases_.begin(), bases_.end(), [&](const AngleBasis& b) { return b.name() == name; });
        if (own != bases_.end())
            return *own;
        if (const AngleBasis* known = AngleBasis::known(name))
            return *known;
        throw InputError{at(block), std::string(kind) + " \"" + name + "\" is not known",
                         "the file can define it, or use LBNL/Klems Full, Half or Quarter"};
    }
    void wavelength(const pugi::xml_node& data)
    {
        const std::string light = text_of(data, "Wavelength");
        const std::string kind = lowercase_ascii(light);
        if (kind != "visible" && kind != "cie-x" && kind != "cie-z") {
            if (about_.not_read.find(light) == std::string::npos)
                about_.not_read += (about_.not_read.empty() ? "" : ", ") + light;
            return;
        }
        for (const pugi::xml_node block : data.children("WavelengthDataBlock"))
            add(block, kind);
    }
    struct Target {
        std::string_view direction;
        std::shared_ptr<const DirectionTable>* part;
        ColourTables* beside;
    };
    /// The front of the file is the outer side, whose normal points away from the room; ours is the other.
    std::array<Target, 4> targets()
    {
        return {{{"reflection back", &parts_.front, &parts_.beside_front},
                 {"reflection front", &parts_.back, &parts_.beside_back},
                 {"transmission back", &parts_.from_front, &parts_.beside_from_front},
                 {"transmission front", &parts_.from_back, &parts_.beside_from_back}}};
    }
    void add(const pugi::xml_node& block, std::string_view kind)
    {
        const std::string direction = lowercase_ascii(text_of(block, "WavelengthDataDirection"));
        for (const Target& target : targets())
            if (target.direction == direction) {
                (kind == "visible" ? *target.part
                 : kind == "cie-x" ? target.beside->x
                                   : target.beside->z) = table_of(block);
                return;
            }
        throw InputError{at(block), "WavelengthDataDirection is \"" + direction + '"',
                         "expected Transmission or Reflection, Front or Back"};
    }
    std::shared_ptr<const DirectionTable> table_of(const pugi::xml_node& block) const
    {
        const pugi::xml_node data = block.child("ScatteringData");
        const std::string place = at(data ? data : block);
        const std::string_view text = data.text().get();
        for (const int coordinates : {3, 4})
            if (structure_ == "TensorTree" + std::to_string(coordinates))
                return std::make_shared<const TreeTable>(
                    std::make_shared<const ValueTree>(parse_tree(text, coordinates, place)));
        if (structure_ != "Columns" && structure_ != "Rows")
            throw InputError{file_, "IncidentDataStructure is \"" + structure_ + '"',
                             "expected Columns, Rows, TensorTree3 or TensorTree4"};
        const AngleBasis& incident = basis(block, "ColumnAngleBasis");
        const AngleBasis& outgoing = basis(block, "RowAngleBasis");
        const auto ins = static_cast<std::size_t>(incident.size()), outs = static_cast<std::size_t>(outgoing.size());
        std::vector<double> values = numbers(text, ins * outs, place);
        if (structure_ == "Rows") { // a row holds what one incident direction gives
            std::vector<double> by_row(values.size());
            for (std::size_t i = 0; i < ins; ++i)
                for (std::size_t o = 0; o < outs; ++o)
                    by_row[o * ins + i] = values[i * outs + o];
            values = std::move(by_row);
        }
        return std::make_shared<const MatrixTable>(incident, outgoing, std::move(values));
    }
    static std::vector<double> numbers(std::string_view text, std::size_t count, const std::string& place)
    {
        std::vector<double> values;
        for (const std::string_view word : split(text, " ,\t\r\n")) {
            const auto value = parse_double(word);
            if (!value || !std::isfinite(*value))
                throw InputError{place, "value " + std::to_string(values.size() + 1) + " is \"" +
                                            std::string(word.substr(0, 20)) + "\", expected a finite number"};
            values.push_back(std::max(0.0, *value)); // differences of measurements come out slightly negative
        }
        if (values.size() != count)
            throw InputError{place,
                             std::to_string(values.size()) + " values, expected " + std::to_string(count) +
                                 " for these angle bases",
                             "the file is damaged, or names another basis"};
        return values;
    }

    std::string_view xml_;
    std::string file_;
    pugi::xml_document document_;
    std::string structure_;
    std::vector<AngleBasis> bases_;
    MeasuredTable::Parts parts_;
    MeasuredTable::About about_;
};

} // namespace

std::shared_ptr<const MeasuredTable> MeasuredTable::parse(std::string_view xml, const std::string& file)
{
    return Reader(xml, file).table();
}

std::shared_ptr<const MeasuredTable> MeasuredTable::read(const std::filesystem::path& file)
{
    return parse(MappedFile(file).bytes(), file.string());
}

} // namespace lightwell
