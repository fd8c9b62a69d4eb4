#include "importers/generators/scene_text_out.h"

#include <algorithm>
#include <fmt/format.h>

namespace lightwell {
namespace {

using namespace generators;

constexpr const char* usage =
    "Usage: genbox material name xsize ysize zsize [-i] [-b bevel | -r round [-n segments [-s]]] [-o]\n";

struct Box {
    std::string material, name;
    Vec3 size;
    double cut = 0; ///< of the edges: bevel or round
    bool round = false, inwards = false, as_obj = false;
};

/// Corner 0 to 7: bit 0 is x, bit 1 y, bit 2 z. Letters name corners that are moved inwards by the cut, but not along
/// the axis of the face they lie in: c to j along y, k to r along x, M to T along z, s to z along none.
Point corner_of(const Box& box, char letter)
{
    int corner = 0, kept_axis = 3;
    if (letter >= '0' && letter <= '7') {
        corner = letter - '0';
        kept_axis = -1;
    } else if (letter >= 'c' && letter <= 'j') {
        corner = letter - 'c';
        kept_axis = 1;
    } else if (letter >= 'k' && letter <= 'r') {
        corner = letter - 'k';
        kept_axis = 0;
    } else if (letter >= 'M' && letter <= 'T') {
        corner = letter - 'M';
        kept_axis = 2;
    } else {
        corner = letter - 's';
    }
    // A box that looks inwards is mirrored through its centre, so that each face keeps its name and its order.
    if (box.inwards)
        corner = 7 - corner;
    Point point;
    for (int axis = 0; axis < 3; ++axis) {
        const double inset = kept_axis == -1 || kept_axis == axis ? 0 : box.cut;
        point[axis] = (corner >> axis & 1) != 0 ? box.size[axis] - inset : inset;
    }
    return point;
}

/// Faces by their corners, in the order in which other programs know them.
constexpr const char* plain_faces[] = {"1540", "4620", "2310", "3267", "5137", "6457"};
constexpr const char* cut_faces[] = {"dhgc", "oqmk", "OPNM", "feij", "plnr", "SQRT"};
constexpr const char* bevel_faces[] = {"NdcM", "kmOM", "cgok", "QSqo", "TjiS", "emqi", "efPO", "jrnf", "lNPn", "prTR",
                                       "hdlp", "QghR", "Mck",  "dNl",  "Ome",  "ogQ",  "Siq",  "pRh",  "fnP",  "Trj"};
constexpr const char* round_edges[] = {"st", "sw", "su", "vt", "vu", "vz", "xt", "xw", "xz", "yu", "yw", "yz"};

void append_face(std::string& text, const Box& box, const std::string& letters)
{
    std::vector<Point> corners;
    for (const char letter : letters)
        corners.push_back(corner_of(box, letter));
    if (!box.as_obj)
        return append_polygon(text, box.material, box.name + '.' + letters, corners);
    for (const Point& corner : corners)
        text += fmt::format("v\t{:.12g}\t{:.12g}\t{:.12g}\n", corner.x, corner.y, corner.z);
    text += "f";
    for (std::size_t i = corners.size(); i > 0; --i)
        text += fmt::format(" -{}", i);
    text += '\n';
}

void append_rounds(std::string& text, const Box& box)
{
    for (const char* edge : round_edges)
        append_round(text, box.material, box.inwards ? "tube" : "cylinder", box.name + '.' + edge,
                     {corner_of(box, edge[0]), corner_of(box, edge[1])}, {box.cut});
    for (char letter = 's'; letter <= 'z'; ++letter)
        append_round(text, box.material, box.inwards ? "bubble" : "sphere", box.name + '.' + letter,
                     {corner_of(box, letter)}, {box.cut});
}

Box box_of(WordReader& words)
{
    Box box;
    box.material = words.word("material");
    box.name = words.word("name");
    for (int axis = 0; axis < 3; ++axis)
        if (!((box.size[axis] = words.number("size")) > 0))
            throw BadWords("Use error - sizes must be positive");
    while (words.more()) {
        const std::string option = words.word("option");
        if (option == "-i") {
            box.inwards = true;
        } else if (option == "-o") {
            box.as_obj = true;
        } else if (option == "-b" || option == "-r") {
            box.cut = words.number("bevel or round");
            box.round = option == "-r";
            if (!(box.cut > 0) || !(2 * box.cut < std::min(box.size.x, std::min(box.size.y, box.size.z))))
                throw BadWords("Use error - bevel or round must be positive and less than half of each size");
        } else if (option == "-n") { // facets of round edges in OBJ; in scene text they are round
            words.count("segments", 1, 10'000);
        } else if (option != "-s") {
            throw BadWords("Use error - unknown option: " + option);
        }
    }
    if (box.round && box.as_obj)
        throw BadWords("Use error - rounded boxes are not written as OBJ");
    return box;
}

} // namespace

GeneratorAnswer genbox(const std::vector<std::string>& words, const GeneratorInput&)
{
    return answered(words, usage, [&](GeneratorAnswer& answer) {
        WordReader reader(words);
        const Box box = box_of(reader);
        answer.text = comment_of(words);
        if (box.as_obj)
            answer.text += "usemtl " + box.material + "\ng " + box.name + '\n';
        if (box.cut == 0) {
            for (const char* face : plain_faces)
                append_face(answer.text, box, face);
            return;
        }
        for (const char* face : cut_faces)
            append_face(answer.text, box, face);
        if (box.round)
            return append_rounds(answer.text, box);
        for (const char* face : bevel_faces)
            append_face(answer.text, box, face);
    });
}

} // namespace lightwell
