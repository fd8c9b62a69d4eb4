#include "engine/base/text.h"
#include "importers/dxf/shapes.h"

#include <unordered_map>

namespace lightwell::dxf {
namespace {

struct TypesOfReason {
    SkipReason reason;
    const char* types;
};

constexpr TypesOfReason known_types[] = {
    {{"annotation"},
     "TEXT MTEXT RTEXT ARCALIGNEDTEXT ATTDEF ATTRIB DIMENSION ARC_DIMENSION LARGE_RADIAL_DIMENSION LEADER MLEADER "
     "MULTILEADER TOLERANCE SHAPE ACAD_TABLE VIEWPORT"},
    {{"a curve without thickness has no area"}, "POINT RAY XLINE HELIX"},
    {{"solids and surfaces in ACIS form are not modelled; explode them to faces", true},
     "3DSOLID REGION BODY SURFACE EXTRUDEDSURFACE LOFTEDSURFACE REVOLVEDSURFACE SWEPTSURFACE PLANESURFACE "
     "NURBSURFACE"},
    {{"pictures and embedded objects are not modelled", true},
     "IMAGE WIPEOUT OLEFRAME OLE2FRAME PDFUNDERLAY DWFUNDERLAY DGNUNDERLAY"},
    {{"the sun of the drawing is not taken over; give place and time", true}, "SUN"},
    {{"objects of other applications are not modelled", true}, "ACAD_PROXY_ENTITY"},
    {{"vertex without a polyline", true}, "VERTEX"},
};
constexpr SkipReason unknown{"not a known entity type", true};

} // namespace

Reason reason_of_type(const std::string& type)
{
    static const auto reasons = [] {
        std::unordered_map<std::string, Reason> table;
        for (const TypesOfReason& entry : known_types)
            for (const std::string_view name : split(entry.types))
                table.emplace(name, &entry.reason);
        return table;
    }();
    const auto found = reasons.find(type);
    return found == reasons.end() ? &unknown : found->second;
}

} // namespace lightwell::dxf
