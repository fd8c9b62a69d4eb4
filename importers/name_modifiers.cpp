#include "importers/name_modifiers.h"

#include "importers/laid_pictures.h"

#include <map>
#include <set>
#include <unordered_map>

namespace lightwell {
namespace {

Material with_half_radiance(Material material)
{
    std::visit(
        [](auto& what) {
            if constexpr (requires { what.radiance; })
                what.radiance *= Spectrum::grey(0.5);
        },
        material);
    return material;
}

/// Calls change(id) for every modifier id of a scene's parts.
template <class Change>
void visit_ids(Scene& scene, const Change& change)
{
    const auto visit = [&](Part& part) {
        for (Surface& surface : part.surfaces)
            change(surface.modifier);
        for (Instance& instance : part.instances)
            for (Binding& binding : instance.bindings) {
                change(binding.inherited);
                change(binding.actual);
            }
    };
    visit(scene.root);
    for (Part& part : scene.prototypes)
        visit(part);
}

class Namer {
public:
    Namer(Imported& imported, const std::vector<Choice>& choices)
        : imported_(imported), choices_(choices), pictures_(imported)
    {
    }
    void run();

private:
    std::size_t base(ModifierId id) const { return static_cast<std::size_t>(id) % choices_.size(); }
    bool is_half(ModifierId id) const { return static_cast<std::size_t>(id) >= choices_.size(); }
    std::string material_name(ModifierId id) const
    {
        const Choice& choice = choices_[base(id)];
        return choice.name + (is_half(id) ? ".half" : "") + (choice.seen_only() ? ".seen" : "");
    }
    const std::string& layer(ModifierId id) const
    {
        return base(id) < imported_.keys.size() ? imported_.keys[base(id)].layer
                                                : imported_.scene.modifiers[base(id)].name;
    }

    void collect_used();
    void use_settled(std::size_t modifier);
    void add_materials();
    ModifierId add_pictures(const Choice& choice, const std::string& material);
    void add_aliases();
    void add_others();
    ModifierId add(Modifier modifier, SurfaceKey key);
    std::string unused_name(const std::string& wanted, const std::string& suffix);

    Imported& imported_;
    const std::vector<Choice>& choices_;
    LaidPictures pictures_;
    std::set<std::string> pictured_; ///< materials of the scene on surfaces that have coordinates on pictures
    std::vector<ModifierId> used_;   ///< in order of first appearance
    std::set<ModifierId> known_;
    std::map<std::string, std::set<std::string>> materials_of_layer_;
    std::unordered_map<std::string, ModifierId> material_ids_;
    std::unordered_map<ModifierId, ModifierId> new_ids_;
    std::vector<Modifier> modifiers_;
    std::vector<SurfaceKey> keys_;
    std::set<std::string> names_;
};

/// Entries that were complete before bring along what they refer to.
void Namer::use_settled(std::size_t modifier)
{
    std::vector<ModifierId> pending{static_cast<ModifierId>(modifier)};
    while (!pending.empty()) {
        const Modifier& entry = imported_.scene.modifiers[base(pending.back())];
        pending.pop_back();
        const auto* alias = std::get_if<Alias>(&entry.what);
        for (const ModifierId next : {entry.parent, alias ? alias->target : void_modifier})
            if (next != void_modifier && known_.insert(next).second) {
                used_.push_back(next);
                pending.push_back(next);
            }
    }
}

void Namer::collect_used()
{
    visit_ids(imported_.scene, [&](ModifierId& id) {
        if (id == void_modifier || !known_.insert(id).second)
            return;
        used_.push_back(id);
        const Choice& choice = choices_[base(id)];
        if (choice.kind == Choice::Kind::material)
            materials_of_layer_[layer(id)].insert(material_name(id));
        else if (choice.kind == Choice::Kind::settled)
            use_settled(base(id));
    });
}

ModifierId Namer::add(Modifier modifier, SurfaceKey key)
{
    names_.insert(modifier.name);
    modifiers_.push_back(std::move(modifier));
    keys_.push_back(std::move(key));
    return static_cast<ModifierId>(modifiers_.size() - 1);
}

std::string Namer::unused_name(const std::string& wanted, const std::string& suffix)
{
    std::string name = wanted;
    for (int number = 1; names_.contains(name); ++number)
        name = wanted + suffix + (number > 1 ? std::to_string(number) : "");
    return name;
}

/// The patterns and textures that lie on a material of the file.
/// @return  the last of them, the material's own modifier
ModifierId Namer::add_pictures(const Choice& choice, const std::string& material)
{
    ModifierId last = void_modifier;
    if (choice.file_material.empty() || !pictured_.contains(material))
        return last;
    for (Varying& laid : pictures_.on(choice.file_material)) {
        const char* kind = laid.kind == Varying::Kind::texture ? ".normals" : ".picture";
        const std::string name = unused_name(material + kind, ".");
        last = add({name, std::move(laid), last}, {name, {}, {}, choice.name, {}, {}});
    }
    return last;
}

void Namer::add_materials()
{
    const std::set<ModifierId> with_coordinates = modifiers_with_coordinates(imported_.scene);
    for (const ModifierId id : used_)
        if (choices_[base(id)].kind == Choice::Kind::material && with_coordinates.contains(id))
            pictured_.insert(material_name(id));
    for (const ModifierId id : used_) {
        const Choice& choice = choices_[base(id)];
        if (choice.kind != Choice::Kind::material || material_ids_.contains(material_name(id)))
            continue;
        // In scene text a name means its last definition: a layer of the same name must not hide the material.
        std::string name = material_name(id);
        if (materials_of_layer_.contains(name))
            name = unused_name(name + ".material", ".");
        Material material = is_half(id) ? with_half_radiance(*choice.definition) : *choice.definition;
        if (choice.seen_only()) {
            const std::string look = unused_name(name + ".look", ".");
            add({look, material, void_modifier}, {look, {}, {}, choice.name, {}, {}});
            material = Illum{{}, look};
        }
        const ModifierId pictures = add_pictures(choice, material_name(id));
        material_ids_[material_name(id)] = add({name, material, pictures}, {name, {}, {}, choice.name, {}, {}});
    }
}

void Namer::add_aliases()
{
    std::map<std::pair<std::string, std::string>, ModifierId> aliases;
    for (const ModifierId id : used_) {
        if (choices_[base(id)].kind != Choice::Kind::material)
            continue;
        const std::string material = material_name(id);
        const auto [entry, fresh] = aliases.try_emplace({layer(id), material});
        if (fresh) {
            const bool several = materials_of_layer_[layer(id)].size() > 1;
            const std::string name = unused_name(several ? layer(id) + '/' + material : layer(id), "~");
            entry->second = add({name, Alias{material_ids_[material]}, void_modifier}, imported_.keys[base(id)]);
        }
        new_ids_[id] = entry->second;
    }
}

/// Place-holders and complete entries, unchanged but for the ids they refer to.
void Namer::add_others()
{
    for (const ModifierId id : used_) {
        const Choice::Kind kind = choices_[base(id)].kind;
        if (kind != Choice::Kind::inherited && kind != Choice::Kind::settled)
            continue;
        const std::string name =
            unused_name(imported_.scene.modifiers[base(id)].name, kind == Choice::Kind::inherited ? "/inherited" : "~");
        names_.insert(name);
        new_ids_[id] = static_cast<ModifierId>(modifiers_.size());
        modifiers_.push_back(imported_.scene.modifiers[base(id)]);
        modifiers_.back().name = name;
        keys_.push_back(base(id) < imported_.keys.size() ? imported_.keys[base(id)]
                                                         : SurfaceKey{name, {}, {}, {}, {}, {}});
    }
    const auto renewed = [&](ModifierId id) { return id == void_modifier ? id : new_ids_.at(id); };
    for (const ModifierId id : used_) {
        if (choices_[base(id)].kind != Choice::Kind::settled)
            continue;
        Modifier& entry = modifiers_[static_cast<std::size_t>(new_ids_.at(id))];
        entry.parent = renewed(entry.parent);
        if (auto* alias = std::get_if<Alias>(&entry.what))
            alias->target = renewed(alias->target);
    }
}

void Namer::run()
{
    if (choices_.empty())
        return;
    collect_used();
    add_materials();
    add_aliases();
    add_others();
    visit_ids(imported_.scene, [&](ModifierId& id) {
        if (id != void_modifier)
            id = new_ids_.at(id);
    });
    imported_.scene.modifiers = std::move(modifiers_);
    imported_.keys = std::move(keys_);
    imported_.made_with_key.clear();
}

} // namespace

void name_modifiers(Imported& imported, const std::vector<Choice>& choices)
{
    Namer{imported, choices}.run();
}

} // namespace lightwell
