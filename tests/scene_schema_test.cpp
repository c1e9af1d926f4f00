// The schema of scenes says the same as fields.hpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "pliant/scene.hpp"
#include "scene/fields.hpp"
#include "scene_file/document.hpp"
#include "test_paths.hpp"

namespace pliant {
namespace {

const std::filesystem::path root = test::project_folder;

/// Visits the fields of a scene made of defaults beside the schema's description of it.
class SchemaComparison {
public:
    using Json = scene_format::Json;
    using Range = scene_format::Range;
    using Names = scene_format::Names;
    using Presence = scene_format::Presence;

    SchemaComparison(const Json& whole, const Json& schema, std::string path)
        : whole_(whole), schema_(resolved(schema)), path_(std::move(path))
    {
    }

    void number(const char* key, double value, const Range& range, const char* unit, Presence presence = {})
    {
        compare_number(property(key, presence), "number", range);
        compare_rest(key, value, unit, presence);
    }
    void number(const char* key, std::uint32_t value, const Range& range, const char* unit,
                Presence presence = {})
    {
        compare_number(property(key, presence), "integer", range);
        const bool has_default = std::string(key) != "index";
        compare_rest(key, value, unit, has_default ? presence : scene_format::required);
    }
    void number(const char* key, const std::optional<double>&, const Range& range, const char* unit)
    {
        compare_number(property(key), "number", range);
        compare_rest(key, nullptr, unit, scene_format::required);
    }
    void vector(const char* key, const Vec3d& value, const Range& range, const char* unit,
                Presence presence = {})
    {
        const Json array = property(key, presence);
        EXPECT_EQ(array.value("minItems", 0), 3) << path_ << key;
        EXPECT_EQ(array.value("maxItems", 0), 3) << path_ << key;
        compare_number(resolved(array.value("items", Json())), "number", range);
        compare_rest(key, {value.x, value.y, value.z}, unit, presence);
    }
    template <class Enumeration>
    void choice(const char* key, Enumeration value, Names names)
    {
        const Json allowed = property(key);
        EXPECT_EQ(allowed.value("enum", Json()), Json(std::vector<std::string>(names.begin(), names.end())))
            << path_ << key;
        const std::string by_default = names[static_cast<std::size_t>(value)];
        EXPECT_EQ(allowed.value("default", by_default), by_default) << path_ << key;
    }
    void flag(const char* key, bool value)
    {
        const Json schema = property(key);
        EXPECT_EQ(schema.value("type", ""), "boolean") << path_ << key;
        EXPECT_EQ(schema.value("default", value), value) << path_ << key;
    }
    void text(const char* key, const std::string&)
    {
        EXPECT_EQ(property(key).value("type", ""), "string") << path_ << key;
    }
    void name(const char* key, const std::string& value) { text(key, value); }
    void format_version(const char* key)
    {
        EXPECT_EQ(property(key, scene_format::required).value("const", 0), 1);
        seen_.insert("$schema");
    }
    void step_length(const char* key, const TimeOptions&)
    {
        compare_number(property(key), "number", scene_format::above(0, 1));
    }
    void material(const char* key, const Cloth& cloth)
    {
        choice(key, cloth.material, scene_format::material_names);
    }
    void mesh_file(const char* key, const SurfaceMesh&) { property(key, scene_format::required); }
    void checks(const char* key, const std::vector<Check>&)
    {
        nested(key, [](auto& inside) {
            for (const char* check : scene_format::check_names) inside.property(check);
        });
    }

    template <class Inside>
    void nested(const char* key, Inside inside, Presence presence = {})
    {
        visit(property(key, presence), std::string(key), inside);
    }
    template <class Thing>
    void object(const char* key, const std::optional<Thing>&)
    {
        nested(key, [](auto& inside) {
            const Thing thing{};
            scene_format::fields(inside, thing);
        });
    }
    template <class Thing>
    void object(const char* key, const Thing& thing)
    {
        nested(key, [&](auto& inside) { scene_format::fields(inside, thing); });
    }
    template <class Thing>
    void list(const char* key, const std::vector<Thing>&)
    {
        visit(property(key).value("items", Json()), std::string(key), [](auto& inside) {
            const Thing thing{};
            scene_format::fields(inside, thing);
        });
    }
    void cloths(const char* key, const Scene&)
    {
        const auto inside = [](auto& at) {
            const Cloth cloth;
            scene_format::fields(at, cloth);
        };
        visit(property(key).value("items", Json()), key, inside);
    }
    void bodies(const char* key, const Scene&)
    {
        const auto inside = [](auto& at) {
            const Cloth body = Cloth::soft_body({});
            scene_format::body_fields(at, body);
        };
        visit(property(key).value("items", Json()), key, inside);
    }
    void body_shape(Names keys, const Cloth& cloth)
    {
        for (const char* key : keys) seen_.insert(key);
        nested("mesh", [&](auto& inside) {
            inside.mesh_file("file", SurfaceMesh{});
            inside.number("scale", cloth.scale, scene_format::extent, "");
            inside.text("weights", "");
        });
        object("icosphere", IcosphereOptions{});
        object("uv_sphere", UvSphereOptions{});
        object("torus", TorusOptions{});
        object("box", BoxOptions{});
        object("capsule", CapsuleOptions{});
        object("blob", BlobOptions{});
    }
    template <class Variant, class With, std::size_t i = 0>
    void one_of(const Variant& variant, Names keys, With with_alternative)
    {
        seen_.insert(keys[i]);
        const std::variant_alternative_t<i, Variant> alternative{};
        with_alternative(keys[i], alternative);
        if constexpr (i + 1 < std::variant_size_v<Variant>)
            one_of<Variant, With, i + 1>(variant, keys, with_alternative);
    }

    void finish() const
    {
        EXPECT_EQ(schema_.value("additionalProperties", true), false) << path_;
        const Json properties = schema_.value("properties", Json::object());
        for (const auto& [key, value] : properties.items())
            EXPECT_TRUE(seen_.contains(key)) << path_ << key << " is in the schema alone";
    }

private:
    template <class Inside>
    void visit(const Json& schema, const std::string& key, Inside inside)
    {
        SchemaComparison child(whole_, schema, path_ + key + ".");
        inside(child);
        child.finish();
    }

    /// The schema with what it refers to put in; what stands beside a reference has the last word.
    Json resolved(Json schema) const
    {
        if (!schema.contains("$ref")) return schema;
        Json target = whole_.at(Json::json_pointer(schema["$ref"].get<std::string>().substr(1)));
        target.update(schema);
        target.erase("$ref");
        return target;
    }
    Json property(const char* key, Presence presence = {})
    {
        seen_.insert(key);
        const Json properties = schema_.value("properties", Json::object());
        EXPECT_TRUE(properties.contains(key)) << path_ << key << " is not in the schema";
        const Json needed = schema_.value("required", Json::array());
        const bool is_required = std::find(needed.begin(), needed.end(), key) != needed.end();
        EXPECT_EQ(is_required, presence == scene_format::required) << path_ << key;
        return properties.contains(key) ? resolved(properties[key]) : Json::object();
    }
    void compare_number(const Json& schema, const std::string& type, const Range& range) const
    {
        EXPECT_EQ(schema.value("type", ""), type) << path_;
        EXPECT_EQ(schema.value(range.min_excluded ? "exclusiveMinimum" : "minimum", -1e300), range.min)
            << path_ << schema;
        EXPECT_EQ(schema.value("maximum", 1e300), range.max) << path_ << schema;
    }
    void compare_rest(const char* key, const Json& value, const std::string& unit, Presence presence)
    {
        const Json schema = property_text(key);
        EXPECT_TRUE(schema.value("description", "").starts_with(unit))
            << path_ << key << " should name " << unit;
        if (presence == Presence::optional) {
            EXPECT_EQ(schema.value("default", value), value) << path_ << key;
        }
    }
    Json property_text(const char* key) const
    {
        const Json properties = schema_.value("properties", Json::object());
        return properties.contains(key) ? resolved(properties[key]) : Json::object();
    }

    const Json& whole_;
    Json schema_;
    std::string path_;
    std::set<std::string> seen_;
};

TEST(Scene, TheSchemaSaysTheSameAsTheReader)
{
    std::ifstream file(root / "scenes/scene.schema.json");
    const auto schema = scene_format::Json::parse(file);
    SchemaComparison comparison(schema, schema, "");
    const Scene defaults;
    scene_format::fields(comparison, defaults);
    comparison.finish();
}

}  // namespace
}  // namespace pliant
