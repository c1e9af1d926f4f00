#include "backend/vulkan/shader_needs.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace pliant::vulkan {
namespace {

// Numbers of the SPIR-V specification.
namespace op {
constexpr std::uint32_t entry_point = 15, execution_mode = 16, type_int = 21, type_float = 22,
                        type_vector = 23, type_array = 28, type_struct = 30, type_pointer = 32, constant = 43,
                        constant_composite = 44, spec_constant = 50, spec_constant_composite = 51,
                        spec_constant_op = 52, function = 54, function_end = 56, function_call = 57,
                        variable = 59, load = 61, store = 62, access_chain = 65, decorate = 71,
                        member_decorate = 72, composite_extract = 81, add = 128, subtract = 130,
                        multiply = 132, divide = 134;
}
namespace spirv {
constexpr std::uint32_t local_size = 17;  // execution mode
constexpr std::uint32_t spec_id = 1, array_stride = 6, built_in = 11, binding = 33,
                        offset = 35;           // decorations
constexpr std::uint32_t work_group_size = 25;  // built-in
constexpr std::uint32_t uniform = 2, work_group = 4, push_constant = 9,
                        storage_buffer = 12;  // storage classes
}  // namespace spirv

using Words = std::span<const std::uint32_t>;

class Module {
public:
    Module(Words code, Words constants) : constants_(constants)
    {
        constexpr std::size_t header_words = 5, bound_word = 3;
        is_variable_.resize(code[bound_word]);
        Function* function = nullptr;
        for (std::size_t at = header_words; at < code.size(); at += code[at] >> 16) {
            const Words words = code.subspan(at, code[at] >> 16);
            const std::uint32_t operation = words[0] & 0xffff;
            if (operation == op::function) function = &functions_[words[2]];
            if (function)
                read(*function, operation, words);
            else
                declare(operation, words);
            if (operation == op::function_end) function = nullptr;
        }
    }

    ShaderNeeds needs() const
    {
        ShaderNeeds needs;
        needs.group_size = group_size_;
        if (const auto found = composites_.find(group_size_id_); found != composites_.end())
            for (std::size_t k = 0; k < 3; ++k) needs.group_size[k] = numbers_.at(found->second[k]);
        const std::set<std::uint32_t> used = reached(&Function::variables),
                                      loaded = reached(&Function::loaded),
                                      stored = reached(&Function::stored);
        for (const auto& [id, variable] : variables_) {
            if (used.count(id) == 0) continue;
            const std::uint32_t type = pointed_.at(variable.pointer);
            const auto place = bindings_.find(id);
            switch (variable.storage) {
                case spirv::storage_buffer:
                    needs.storage_buffers.push_back(place->second);
                    if (loaded.count(id) > 0) needs.read_buffers.push_back(place->second);
                    if (stored.count(id) > 0) needs.written_buffers.push_back(place->second);
                    break;
                case spirv::uniform:
                    needs.uniform_buffers.push_back(place->second);
                    needs.uniform_range = std::max(needs.uniform_range, size_of(type).bytes);
                    break;
                case spirv::push_constant: needs.push_constants += size_of(type).bytes; break;
                case spirv::work_group: needs.shared_memory += size_of(type).bytes; break;
                default: break;
            }
        }
        for (auto* bindings :
             {&needs.storage_buffers, &needs.uniform_buffers, &needs.read_buffers, &needs.written_buffers})
            std::sort(bindings->begin(), bindings->end());
        return needs;
    }

private:
    struct Size {
        std::uint64_t bytes = 0, alignment = 4;
    };
    struct Variable {
        std::uint32_t pointer = 0, storage = 0;
    };
    struct Function {
        std::set<std::uint32_t> variables, called, loaded, stored;
        std::map<std::uint32_t, std::uint32_t> places;  ///< by pointer: the variable that it points into
    };

    void declare(std::uint32_t operation, Words words)
    {
        switch (operation) {
            case op::entry_point: entry_ = words[2]; break;
            case op::execution_mode:
                if (words[2] == spirv::local_size) group_size_ = {words[3], words[4], words[5]};
                break;
            case op::decorate:
                if (words[2] == spirv::binding) bindings_[words[1]] = words[3];
                if (words[2] == spirv::spec_id) spec_ids_[words[1]] = words[3];
                if (words[2] == spirv::array_stride) strides_[words[1]] = words[3];
                if (words[2] == spirv::built_in && words[3] == spirv::work_group_size)
                    group_size_id_ = words[1];
                break;
            case op::member_decorate:
                if (words[3] == spirv::offset) offsets_[{words[1], words[2]}] = words[4];
                break;
            case op::type_int:
            case op::type_float: sizes_[words[1]] = {words[2] / 8, words[2] / 8}; break;
            case op::type_vector: {
                const Size part = size_of(words[2]);
                const std::uint32_t count = words[3];
                sizes_[words[1]] = {count * part.bytes, (count == 3 ? 4 : count) * part.bytes};
                break;
            }
            case op::type_array: {
                const Size part = size_of(words[2]);
                const auto stride = strides_.find(words[1]);
                const std::uint64_t each =
                    stride != strides_.end() ? stride->second : rounded(part.bytes, part.alignment);
                sizes_[words[1]] = {each * numbers_.at(words[3]), part.alignment};
                break;
            }
            case op::type_struct: sizes_[words[1]] = size_of_members(words[1], words.subspan(2)); break;
            case op::type_pointer: pointed_[words[1]] = words[3]; break;
            case op::constant: numbers_[words[2]] = words[3]; break;
            case op::spec_constant: {
                const auto id = spec_ids_.find(words[2]);
                numbers_[words[2]] = id != spec_ids_.end() && id->second < constants_.size()
                                         ? constants_[id->second]
                                         : words[3];
                break;
            }
            case op::constant_composite:
            case op::spec_constant_composite:
                composites_[words[2]].assign(words.begin() + 3, words.end());
                break;
            case op::spec_constant_op: numbers_[words[2]] = computed(words[3], words.subspan(4)); break;
            case op::variable:
                variables_[words[2]] = {words[1], words[3]};
                is_variable_[words[2]] = true;
                break;
            default: break;
        }
    }

    /// Literal words may be mistaken for variables; a function then seems to use more than it does, never
    /// less.
    void read(Function& function, std::uint32_t operation, Words words)
    {
        const auto place_of = [&](std::uint32_t pointer) {
            const auto place = function.places.find(pointer);
            return place == function.places.end() ? pointer : place->second;
        };
        switch (operation) {
            case op::function_call: function.called.insert(words[3]); break;
            case op::access_chain: function.places[words[2]] = place_of(words[3]); break;
            case op::load: function.loaded.insert(place_of(words[3])); break;
            case op::store: function.stored.insert(place_of(words[1])); break;
            default: break;
        }
        for (const std::uint32_t word : words.subspan(1))
            if (word < is_variable_.size() && is_variable_[word]) function.variables.insert(word);
    }

    static std::uint64_t rounded(std::uint64_t bytes, std::uint64_t alignment)
    {
        return (bytes + alignment - 1) / alignment * alignment;
    }

    /// Types without a fixed size, such as runtime arrays, count as 0.
    Size size_of(std::uint32_t type) const
    {
        const auto found = sizes_.find(type);
        return found == sizes_.end() ? Size{} : found->second;
    }

    /// Blocks have explicit offsets; shared memory is counted as if laid out by std430.
    Size size_of_members(std::uint32_t type, Words members) const
    {
        Size whole;
        for (std::uint32_t m = 0; m < members.size(); ++m) {
            const Size part = size_of(members[m]);
            const auto place = offsets_.find({type, m});
            const std::uint64_t first =
                place != offsets_.end() ? place->second : rounded(whole.bytes, part.alignment);
            whole.bytes = std::max(whole.bytes, first + part.bytes);
            whole.alignment = std::max(whole.alignment, part.alignment);
        }
        whole.bytes = rounded(whole.bytes, whole.alignment);
        return whole;
    }

    /// The value of an expression for the size of an array; else 0.
    std::uint32_t computed(std::uint32_t operation, Words operands) const
    {
        if (operation == op::composite_extract) return numbers_.at(composites_.at(operands[0])[operands[1]]);
        if (operands.size() != 2 || numbers_.count(operands[0]) == 0 || numbers_.count(operands[1]) == 0)
            return 0;
        const std::uint32_t a = numbers_.at(operands[0]), b = numbers_.at(operands[1]);
        switch (operation) {
            case op::add: return a + b;
            case op::subtract: return a - b;
            case op::multiply: return a * b;
            case op::divide: return b == 0 ? 0 : a / b;
            default: return 0;
        }
    }

    /// The union over all reachable functions.
    std::set<std::uint32_t> reached(std::set<std::uint32_t> Function::*of_function) const
    {
        std::set<std::uint32_t> all, seen;
        std::vector<std::uint32_t> left{entry_};
        while (!left.empty()) {
            const std::uint32_t id = left.back();
            left.pop_back();
            if (!seen.insert(id).second) continue;
            const Function& function = functions_.at(id);
            all.insert((function.*of_function).begin(), (function.*of_function).end());
            left.insert(left.end(), function.called.begin(), function.called.end());
        }
        return all;
    }

    Words constants_;
    std::uint32_t entry_ = 0, group_size_id_ = 0;
    std::array<std::uint32_t, 3> group_size_{1, 1, 1};
    std::map<std::uint32_t, std::uint32_t> bindings_, spec_ids_, strides_, numbers_, pointed_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> offsets_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> composites_;
    std::map<std::uint32_t, Size> sizes_;
    std::map<std::uint32_t, Variable> variables_;
    std::map<std::uint32_t, Function> functions_;
    std::vector<bool> is_variable_;  // by id
};

}  // namespace

ShaderNeeds needs_of(std::span<const std::uint32_t> code, std::span<const std::uint32_t> constants)
{
    return Module(code, constants).needs();
}

}  // namespace pliant::vulkan
