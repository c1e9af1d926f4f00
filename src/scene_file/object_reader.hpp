// Fills the fields of an object from JSON: checks types, tracks the path, rejects unknown keys. Ranges are
// validated later, on the complete scene, except that integers must fit their types.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/fields.hpp"
#include "scene_file/document.hpp"

namespace pliant::scene_format {

class ObjectReader {
public:
    /// Reads one object: calls `inside` with its reader. `folder`: base of relative file names.
    template <class Inside>
    static void read(const Json& value, const std::string& path, const std::filesystem::path& folder,
                     Inside inside)
    {
        ObjectReader reader(value, path, folder);
        inside(reader);
        reader.finish();
    }

    void number(const char* key, double& field, const Range& range, const char* unit, Presence presence = {});
    void number(const char* key, std::optional<double>& field, const Range& range, const char* unit);
    void number(const char* key, std::uint32_t& field, const Range& range, const char* unit,
                Presence presence = {});
    void vector(const char* key, Vec3d& field, const Range& range, const char* unit, Presence presence = {});
    void flag(const char* key, bool& field);
    void text(const char* key, std::string& field, Presence presence = {});
    void name(const char* key, std::string& field) { text(key, field); }

    template <class Enumeration>
    void choice(const char* key, Enumeration& field, Names names)
    {
        if (const Json* value = find(key))
            field = static_cast<Enumeration>(choice_index(*value, path_of(key), names));
    }

    template <class Inside>
    void nested(const char* key, Inside inside, Presence presence = {})
    {
        if (const Json* value = find(key, presence)) read(*value, path_of(key), folder_, inside);
    }

    template <class Thing>
    void object(const char* key, Thing& thing)
    {
        nested(key, [&](ObjectReader& inside) { fields(inside, thing); });
    }
    /// An optional object.
    template <class Thing>
    void object(const char* key, std::optional<Thing>& thing)
    {
        nested(key, [&](ObjectReader& inside) { fields(inside, thing.emplace()); });
    }

    template <class Thing>
    void list(const char* key, std::vector<Thing>& things)
    {
        each(key, [&](ObjectReader& inside) { fields(inside, things.emplace_back()); });
    }

    template <class Variant, class With>
    void one_of(Variant& variant, Names keys, With with)
    {
        const std::size_t index = the_only_key(keys);
        if (index < keys.size()) alternatives(variant, index, keys[index], with);
    }

    void format_version(const char* key);
    void step_length(const char* key, TimeOptions& time);
    void mesh_file(const char* key, SurfaceMesh& mesh);
    void vertex_weights(const char* key, const SurfaceMesh& mesh, std::vector<float>& weights);
    void body_shape(Names keys, Cloth& cloth);
    void material(const char* key, Cloth& cloth);
    void cloths(const char* key, Scene& scene);
    void bodies(const char* key, Scene& scene);
    void checks(const char* key, std::vector<Check>& checks);

private:
    ObjectReader(const Json& value, std::string path, std::filesystem::path folder);

    /// Throws for unknown keys first: a mistyped key explains a missing one.
    void finish() const;

    /// The value of a key, or null; `finish` reports a missing required key.
    const Json* find(const char* key, Presence presence = {});
    /// The index of the only key present; keys.size() if there is none, which `finish` reports.
    std::size_t the_only_key(Names keys);
    std::string path_of(const char* key) const { return member_path(path_, key); }

    static std::size_t choice_index(const Json& value, const std::string& path, Names names);

    template <class Inside>
    void each(const char* key, Inside inside)
    {
        const Json* array = find(key);
        if (!array) return;
        if (!array->is_array()) throw FieldError(path_of(key), wrong_type(*array, "an array of objects"));
        for (std::size_t i = 0; i < array->size(); ++i)
            read((*array)[i], element_path(path_of(key), i), folder_, inside);
    }

    /// Makes alternative `index` of the variant active and passes it on.
    template <class Variant, class With, std::size_t i = 0>
    static void alternatives(Variant& variant, std::size_t index, const char* key, With& with)
    {
        if (index == i)
            with(key, variant.template emplace<i>());
        else if constexpr (i + 1 < std::variant_size_v<Variant>)
            alternatives<Variant, With, i + 1>(variant, index, key, with);
    }

    const Json* object_;
    std::string path_;
    std::filesystem::path folder_;
    std::vector<const char*> known_;
    std::optional<FieldError> missing_;  // for the first missing required key
};

}  // namespace pliant::scene_format
