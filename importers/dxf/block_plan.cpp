#include "importers/dxf/block_plan.h"

#include "engine/base/errors.h"
#include "importers/dxf/geometry.h"

#include <fmt/format.h>

#include <algorithm>

namespace lightwell::dxf {
namespace {

/// Each copy takes some 200 bytes: a gigabyte.
constexpr double most_copies = 5e6;

class BlockPlanner {
public:
    explicit BlockPlanner(const Drawing& drawing) : drawing_(drawing), states_(2 * drawing.blocks.size()) {}
    std::vector<BlockUse> plan();

private:
    enum class State : std::uint8_t { unseen, open, done };

    /// Calls use(insert, inserted) for each visible INSERT of a range of entities.
    template <class Use>
    void for_each_insert(const EntityRange& range, const BlockUse* around, Use use)
    {
        for (std::size_t i = range.first; i < range.first + range.count; ++i) {
            const Entity& entity = drawing_.entities[i];
            BlockUse inserted;
            if (entity.kind == Kind::insert && !hidden_reason(drawing_, entity, around) &&
                !find_inserted(drawing_, entity, around, inserted))
                use(entity, inserted);
        }
    }
    static std::size_t node(const BlockUse& use) { return 2 * use.block + (use.hides_layer_zero ? 1 : 0); }
    void visit(const Entity& insert, const BlockUse& use);
    std::string chain(const Entity& insert) const;

    const Drawing& drawing_;
    std::vector<State> states_;
    std::vector<BlockUse> order_;
    std::vector<const Entity*> path_; ///< the inserts that are open
};

std::string BlockPlanner::chain(const Entity& insert) const
{
    std::string names;
    for (const Entity* step : path_)
        names += drawing_.block_names[step->block_name] + " > ";
    return names + drawing_.block_names[insert.block_name];
}

void BlockPlanner::visit(const Entity& insert, const BlockUse& use)
{
    constexpr std::size_t deepest = 64; // drawings of whole towns stay below 20
    State& state = states_[node(use)];
    if (state == State::open)
        throw InputError{drawing_.place(insert), "a block contains itself: " + chain(insert),
                         "delete the insert that leads back"};
    if (path_.size() >= deepest)
        throw InputError{drawing_.place(insert),
                         fmt::format("blocks are nested more than {} deep: {}", deepest, chain(insert)),
                         "explode some of them"};
    if (state == State::done)
        return;
    state = State::open;
    path_.push_back(&insert);
    for_each_insert(drawing_.blocks[use.block].entities, &use,
                    [&](const Entity& inner, const BlockUse& inserted) { visit(inner, inserted); });
    path_.pop_back();
    states_[node(use)] = State::done;
    order_.push_back(use);
}

std::vector<BlockUse> BlockPlanner::plan()
{
    for (const EntityRange& range : drawing_.model)
        for_each_insert(range, nullptr, [&](const Entity& insert, const BlockUse& use) { visit(insert, use); });
    std::vector<double> scales(states_.size(), 0.0);
    double copies = 0;
    const auto spread = [&](const BlockUse* around, double scale, const EntityRange& range) {
        for_each_insert(range, around, [&](const Entity& insert, const BlockUse& use) {
            const InsertFrame frame = insert_frame(drawing_, insert);
            scales[node(use)] = std::fmax(scales[node(use)], scale * frame.largest_scale);
            copies += static_cast<double>(frame.columns) * frame.rows;
            if (copies > most_copies)
                throw InputError{drawing_.place(insert),
                                 fmt::format("the drawing has more than {} copies of blocks", most_copies),
                                 "split the drawing"};
        });
    };
    for (const EntityRange& range : drawing_.model)
        spread(nullptr, 1, range);
    for (auto use = order_.rbegin(); use != order_.rend(); ++use) { // outer blocks before inner ones
        use->largest_scale = scales[node(*use)];
        spread(&*use, use->largest_scale, drawing_.blocks[use->block].entities);
    }
    return std::move(order_);
}

/// Counts below one mean one; so do copies that would all stand in the same place.
std::uint32_t copies_along(double count, double step)
{
    return count > 1 && step != 0 ? static_cast<std::uint32_t>(std::fmin(count, most_copies + 1)) : 1;
}

/// Flat blocks are often written with a z scale of 0, which stands for 1 as no scale at all does.
Vec3 scale_of(const Fields& fields, bool& has_zero)
{
    Vec3 scale{fields.get(41, 1), fields.get(42, 1), fields.get(43, 1)};
    for (const int axis : {0, 1, 2})
        if (scale[axis] == 0) {
            scale[axis] = 1;
            has_zero = true;
        }
    return scale;
}

} // namespace

InsertFrame insert_frame(const Drawing& drawing, const Entity& insert)
{
    InsertFrame frame;
    const Fields fields{insert.values};
    const Affine axes = compose(object_axes(fields.extrusion()), Affine::translate(fields.point(10)));
    const Affine turned = compose(axes, Affine::rotate(2, fields.get(50) * radians_per_degree));
    const Vec3 scale = scale_of(fields, frame.has_zero_scale);
    const Block& block = drawing.blocks[drawing.block_of_name[insert.block_name]];
    frame.first = compose(compose(turned, Affine::scale(scale * block.scale)), Affine::translate(-block.base));
    frame.column_step = turned.x * fields.get(44);
    frame.row_step = turned.y * fields.get(45);
    frame.columns = copies_along(fields.get(70, 1), fields.get(44));
    frame.rows = copies_along(fields.get(71, 1), fields.get(45));
    frame.largest_scale = max_abs(scale) * block.scale;
    if (!std::isnormal(frame.first.determinant()))
        throw InputError{
            drawing.place(insert),
            fmt::format("scale is {} x {} x {}, expected numbers whose product is not 0", scale.x, scale.y, scale.z),
            "correct the scale"};
    if (static_cast<double>(frame.columns) * frame.rows > most_copies)
        throw InputError{drawing.place(insert),
                         fmt::format("array of {} x {} copies, expected at most {} together", fields.get(70),
                                     fields.get(71), most_copies),
                         "correct the number of rows and columns"};
    return frame;
}

Reason hidden_reason(const Drawing& drawing, const Entity& entity, const BlockUse* around)
{
    static constexpr SkipReason paper{"in paper space"}, invisible{"invisible"}, frozen{"layer is frozen"},
        off{"layer is off"}, insert_off{"layer of the insert is off"};
    if (entity.in_paper_space && !around)
        return &paper;
    if (entity.is_invisible)
        return &invisible;
    const bool is_insert = entity.kind == Kind::insert; // an insert on a layer that is off still shows other layers
    if (around && entity.layer == 0)
        return around->hides_layer_zero && !is_insert ? &insert_off : nullptr;
    const Layer& layer = drawing.layers[entity.layer];
    if (layer.is_frozen)
        return &frozen;
    return layer.is_off && !is_insert ? &off : nullptr;
}

Reason find_inserted(const Drawing& drawing, const Entity& insert, const BlockUse* around, BlockUse& inserted)
{
    static constexpr SkipReason undefined{"its block is not defined", true},
        external{"its block is drawn in another file; bind the reference", true};
    inserted.block = insert.block_name == no_index ? no_index : drawing.block_of_name[insert.block_name];
    if (inserted.block == no_index)
        return &undefined;
    if (drawing.blocks[inserted.block].source != BlockSource::drawing)
        return &external;
    const bool takes_layer = around && insert.layer == 0;
    inserted.hides_layer_zero = takes_layer ? around->hides_layer_zero : drawing.layers[insert.layer].is_off;
    return nullptr;
}

std::vector<BlockUse> plan_blocks(const Drawing& drawing)
{
    return BlockPlanner{drawing}.plan();
}

} // namespace lightwell::dxf
