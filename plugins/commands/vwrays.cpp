#include "engine/base/text.h"
#include "engine/sampling/path_random.h"
#include "plugins/commands/command_list.h"
#include "plugins/commands/picture_stream.h"
#include "plugins/commands/records.h"
#include "plugins/commands/view_options.h"

#include <istream>
#include <ostream>

namespace lightwell::commands {
namespace {

struct Wish {
    ViewOptions view;
    NumberFormat format = NumberFormat::text;
    bool dimensions = false, positions = false, flush = false;
    int repeat = 1;
    double jitter = 0;
    std::string picture;
};

Wish wish_of(const std::vector<std::string>& words)
{
    Wish wish;
    OptionReader reader(words);
    while (reader.more() && reader.peek().size() > 1 && reader.peek()[0] == '-') {
        if (wish.view.read(reader))
            continue;
        const std::string word = reader.take();
        if (word == "-d")
            wish.dimensions = true;
        else if (word == "-i")
            wish.positions = true;
        else if (word == "-u")
            wish.flush = true;
        else if (word == "-c")
            wish.repeat = reader.integer(word);
        else if (word == "-pj")
            wish.jitter = reader.number(word);
        else if (word.size() == 3 && word.rfind("-f", 0) == 0)
            wish.format = number_format(word[2], word, false);
        else
            throw Fatal("command line error at '" + word + "'");
    }
    if (wish.repeat < 1 || !(wish.jitter >= 0 && wish.jitter <= 1))
        throw Fatal("command line error at '-c' or '-pj'");
    if (reader.more())
        wish.picture = reader.take();
    if (reader.more())
        throw Fatal("depth buffers are not read: '" + reader.take() + "'");
    return wish;
}

/// View and size of a picture in place of view words.
void take_picture(Wish& wish, const Streams& streams)
{
    std::string bytes;
    const Picture picture = read_picture(wish.picture, streams.in, bytes);
    const auto found = picture.header.find("VIEW");
    if (found == picture.header.end())
        throw Fatal("no view in picture \"" + wish.picture + "\"");
    wish.view.words = found->second;
    wish.view.columns = picture.width;
    wish.view.rows = picture.height;
    wish.view.pixel_aspect = 0;
}

class Rays {
public:
    Rays(const Wish& wish, const View& view, std::ostream& out)
        : wish_(wish), camera_(view), limited_(view.aft_m > 0), out_(out, wish.format)
    {
    }

    /// @param x, y  in pixels, y upwards
    void put(double x, double y)
    {
        for (int i = 0; i < wish_.repeat; ++i)
            put_one(x, y);
    }

private:
    void put_one(double x, double y)
    {
        PathRandom random(0, number_++, 0);
        const UnitSquare jitter = random.pair(), lens = random.pair();
        const double px = (x + wish_.jitter * (jitter.u - 0.5)) / wish_.view.columns;
        const double py = (y + wish_.jitter * (jitter.v - 0.5)) / wish_.view.rows;
        ViewRay ray;
        const bool seen = camera_.has_lens() ? camera_.ray(px, py, lens, ray) : camera_.ray(px, py, ray);
        if (!seen)
            ray = {{}, {0, 0, 0}, 0};
        const Vec3 direction = seen && limited_ ? ray.direction * ray.reach_m : ray.direction;
        for (const Vec3& v : {Vec3(ray.origin), direction})
            for (int axis = 0; axis < 3; ++axis)
                out_.number(v[axis]);
        out_.end();
    }

    const Wish& wish_;
    Camera camera_;
    bool limited_;
    NumberOutput out_;
    std::uint64_t number_ = 0;
};

} // namespace

/// vwrays: the rays of a view's pixels, from the top left on.
int vwrays(const std::vector<std::string>& words, const Streams& streams)
{
    Wish wish = wish_of(words);
    if (!wish.picture.empty())
        take_picture(wish, streams);
    const View view = wish.view.view();
    wish.view.fit(view);
    if (wish.dimensions) {
        streams.out << "-x " << wish.view.columns << " -y " << wish.view.rows << " -ld" << (view.aft_m > 0 ? '+' : '-')
                    << '\n';
        return 0;
    }
    Rays rays(wish, view, streams.out);
    if (wish.positions) {
        NumberInput in(streams.in, wish.format);
        while (const auto x = in.next()) {
            const auto y = in.next();
            if (!y)
                throw Fatal("input ended within a pixel position");
            rays.put(*x + 0.5, *y + 0.5);
            if (wish.flush)
                streams.out.flush();
        }
        return 0;
    }
    for (int row = wish.view.rows - 1; row >= 0; --row)
        for (int column = 0; column < wish.view.columns; ++column)
            rays.put(column + 0.5, row + 0.5);
    return 0;
}

} // namespace lightwell::commands
