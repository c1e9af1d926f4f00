#include "scene_file/object_reader.hpp"

#include <algorithm>

namespace pliant::scene_format {

namespace {

double real_number(const Json& value, const std::string& path, const Range& range, const char* unit,
                   NumberKind kind)
{
    if (!value.is_number()) throw FieldError(path, wrong_type(value, expected_number(range, unit, kind)));
    return value.get<double>();
}

const std::string& string_of(const Json& value, const std::string& path)
{
    if (!value.is_string()) throw FieldError(path, wrong_type(value, "a string"));
    return value.get_ref<const std::string&>();
}

}  // namespace

ObjectReader::ObjectReader(const Json& value, std::string path, std::filesystem::path folder)
    : object_(&value), path_(std::move(path)), folder_(std::move(folder))
{
    if (!value.is_object()) throw FieldError(path_, wrong_type(value, "an object"));
}

void ObjectReader::finish() const
{
    for (const auto& [key, value] : object_->items())
        if (std::find(known_.begin(), known_.end(), key) == known_.end())
            throw FieldError(member_path(path_, key), unknown_name(key, known_));
    if (missing_) throw FieldError(*missing_);
}

const Json* ObjectReader::find(const char* key, Presence presence)
{
    known_.push_back(key);
    const auto found = object_->find(key);
    if (found != object_->end()) return &*found;
    if (presence == required && !missing_) missing_.emplace(path_of(key), "is missing");
    return nullptr;
}

std::size_t ObjectReader::the_only_key(Names keys)
{
    std::size_t found = keys.size();
    for (std::size_t i = 0; i < keys.size(); ++i) {
        known_.push_back(keys[i]);
        if (!object_->contains(keys[i])) continue;
        if (found < keys.size())
            throw FieldError(path_of(keys[i]), "is given beside " + std::string(keys[found]) +
                                                   ", but there must be exactly one of " + joined(keys));
        found = i;
    }
    if (found == keys.size() && !missing_)
        missing_.emplace(path_, "has none of " + joined(keys) + ", but must have exactly one");
    return found;
}

std::size_t ObjectReader::choice_index(const Json& value, const std::string& path, Names names)
{
    if (!value.is_string()) throw FieldError(path, wrong_type(value, "one of " + joined(names)));
    const std::string& word = value.get_ref<const std::string&>();
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end())
        throw FieldError(path, "is " + in_quotes(word) + ", " + expected_choice(word, names));
    return static_cast<std::size_t>(found - names.begin());
}

void ObjectReader::number(const char* key, double& field, const Range& range, const char* unit,
                          Presence presence)
{
    if (const Json* value = find(key, presence))
        field = real_number(*value, path_of(key), range, unit, NumberKind::real);
}

void ObjectReader::number(const char* key, std::optional<double>& field, const Range& range, const char* unit)
{
    if (const Json* value = find(key))
        field = real_number(*value, path_of(key), range, unit, NumberKind::real);
}

void ObjectReader::number(const char* key, std::uint32_t& field, const Range& range, const char* unit,
                          Presence presence)
{
    const Json* value = find(key, presence);
    if (!value) return;
    const double number = real_number(*value, path_of(key), range, unit, NumberKind::whole);
    require_number(path_of(key), number, range, unit, NumberKind::whole);
    field = static_cast<std::uint32_t>(number);
    if (number != field)
        throw FieldError(path_of(key), "is " + with_unit(number_text(number), unit) + ", but must be " +
                                           expected_number(range, unit, NumberKind::whole));
}

void ObjectReader::vector(const char* key, Vec3d& field, const Range& range, const char* unit,
                          Presence presence)
{
    const Json* value = find(key, presence);
    if (!value) return;
    const std::string path = path_of(key);
    if (!value->is_array() || value->size() != 3)
        throw FieldError(
            path, wrong_type(*value, "an array of 3 numbers" + (*unit ? " in " + std::string(unit) : "")));
    double* const elements[] = {&field.x, &field.y, &field.z};
    for (std::size_t i = 0; i < 3; ++i)
        *elements[i] = real_number((*value)[i], element_path(path, i), range, unit, NumberKind::real);
}

void ObjectReader::flag(const char* key, bool& field)
{
    const Json* value = find(key);
    if (!value) return;
    if (!value->is_boolean()) throw FieldError(path_of(key), wrong_type(*value, "true or false"));
    field = value->get<bool>();
}

void ObjectReader::text(const char* key, std::string& field, Presence presence)
{
    if (const Json* value = find(key, presence)) field = string_of(*value, path_of(key));
}

void ObjectReader::format_version(const char* key)
{
    constexpr int version = 1;
    known_.push_back("$schema");  // names the schema for editors
    const Json* value = find(key);
    if (!value) throw FieldError(path_of(key), "is missing: a scene starts with \"pliant\": 1");
    if (!value->is_number() || value->get<double>() != version)
        throw FieldError(path_of(key), wrong_type(*value, "1, the only version of the scene format so far"));
}

void ObjectReader::step_length(const char* key, TimeOptions& time)
{
    constexpr Range range = above(0, 1);
    std::optional<double> dt;
    number(key, dt, range, "s");
    if (!dt) return;
    const std::string path = path_of(key);
    require_number(path, *dt, range, "s", NumberKind::real);
    if (object_->contains("frame_rate"))
        throw FieldError(
            path, "is given beside frame_rate, but a frame lasts either 1 / frame_rate or dt * substeps");
    if (time.substeps == 0)
        throw FieldError(path, "is given without substeps of at least 1, but a frame lasts dt * substeps");
    time.frame_rate = 1.0 / (*dt * time.substeps);
    if (time.frame_rate < 1 || time.frame_rate > 10'000)
        throw FieldError(path, "is " + number_text(*dt) + " s, which makes with " +
                                   std::to_string(time.substeps) + " substeps a frame of " +
                                   number_text(*dt * time.substeps) +
                                   " s, but must make one between 1e-4 and 1 s");
}

void ObjectReader::mesh_file(const char* key, SurfaceMesh& mesh)
{
    const Json* value = find(key, required);
    if (!value) return;
    const std::filesystem::path file = folder_ / string_of(*value, path_of(key));
    try {
        mesh = read_mesh(file);
    } catch (const Error& error) {
        throw FieldError(path_of(key), "cannot be used: " + std::string(error.what()));
    }
}

void ObjectReader::vertex_weights(const char* key, const SurfaceMesh& mesh, std::vector<float>& weights)
{
    std::string property;
    text(key, property);
    if (property.empty()) return;
    try {
        weights = read_vertex_attribute(mesh.file, property);
    } catch (const Error& error) {
        throw FieldError(path_of(key), "cannot be used: " + std::string(error.what()));
    }
}

void ObjectReader::material(const char* key, Cloth& cloth)
{
    choice(key, cloth.material, material_names);
    if (cloth.material == Material::none) return;
    cloth.make_of(cloth.material);
    if (object_->contains("node_mass")) cloth.density.reset();
}

void ObjectReader::cloths(const char* key, Scene& scene)
{
    each(key, [&](ObjectReader& inside) {
        Cloth cloth;
        fields(inside, cloth);
        scene.add(std::move(cloth));
    });
}

/// A mesh from a file, or generated here; in either case it is then a mesh of the body.
void ObjectReader::body_shape(Names keys, Cloth& cloth)
{
    const std::size_t index = the_only_key(keys);
    if (index == keys.size()) return;
    const char* key = keys[index];
    const auto made = [&](auto options, SurfaceMesh (*make)(const decltype(options)&)) {
        object(key, options);
        try {
            return make(options);
        } catch (const Error& error) {
            throw FieldError(path_of(key), "cannot be made: " + std::string(error.what()));
        }
    };
    SurfaceMesh mesh;
    switch (index) {
        case 0:
            nested(key, [&](ObjectReader& inside) {
                inside.mesh_file("file", mesh);
                inside.number("scale", cloth.scale, extent, "");
                inside.vertex_weights("weights", mesh, cloth.body->volume.weights);
            });
            break;
        case 1: mesh = made(IcosphereOptions{}, icosphere_mesh); break;
        case 2: mesh = made(UvSphereOptions{}, uv_sphere_mesh); break;
        case 3: mesh = made(TorusOptions{}, torus_mesh); break;
        case 4: mesh = made(BoxOptions{}, box_mesh); break;
        case 5: mesh = made(CapsuleOptions{}, capsule_mesh); break;
        default: mesh = made(BlobOptions{}, blob_mesh); break;
    }
    cloth.shape = std::move(mesh);
}

void ObjectReader::bodies(const char* key, Scene& scene)
{
    each(key, [&](ObjectReader& inside) {
        Cloth cloth = Cloth::soft_body({});
        body_fields(inside, cloth);
        scene.add(std::move(cloth));
    });
}

void ObjectReader::checks(const char* key, std::vector<Check>& checks)
{
    nested(key, [&](ObjectReader& inside) {
        for (const char* name : check_names) {
            const Json* value = inside.find(name);
            if (!value) continue;
            const bool pair =
                value->is_array() && value->size() == 2 && (*value)[0].is_number() && (*value)[1].is_number();
            if (!pair)
                throw FieldError(inside.path_of(name),
                                 wrong_type(*value, "an array of 2 numbers, [min, max]"));
            checks.push_back({name, (*value)[0].get<double>(), (*value)[1].get<double>()});
        }
    });
}

}  // namespace pliant::scene_format
