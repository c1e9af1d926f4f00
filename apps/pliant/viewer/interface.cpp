#include "viewer/interface.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <backends/imgui_impl_vulkan.h>

#include <cmath>

namespace pliant::tool {
namespace {

/// Converts widget colours from sRGB to linear, as the target requires.
void make_linear(ImGuiStyle& style)
{
    for (ImVec4& colour : style.Colors)
        for (float* channel : {&colour.x, &colour.y, &colour.z}) *channel = std::pow(*channel, 2.2f);
}

void name_keys(ImGuiIO& io)
{
    const std::pair<ImGuiKey, int> keys[] = {{ImGuiKey_Tab, GLFW_KEY_TAB},
                                             {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                             {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                             {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                             {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                             {ImGuiKey_Home, GLFW_KEY_HOME},
                                             {ImGuiKey_End, GLFW_KEY_END},
                                             {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                             {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                             {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                             {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                             {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER}};
    for (const auto& [name, code] : keys) io.KeyMap[name] = code;
}

}  // namespace

Interface::Interface(const Screen& screen) : device_(screen.device())
{
    const vk::DescriptorPoolSize size(vk::DescriptorType::eCombinedImageSampler, 1);
    pool_ = {device_->handle(), {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, size}};
    context_ = ImGui::CreateContext();
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // writes no settings file into the working directory
    ImGui::StyleColorsDark();
    ImGui::GetStyle().WindowRounding = 4;
    ImGui::GetStyle().Colors[ImGuiCol_WindowBg].w = 0.88f;
    make_linear(ImGui::GetStyle());
    name_keys(io);

    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = static_cast<VkInstance>(*device_->instance());
    info.PhysicalDevice = static_cast<VkPhysicalDevice>(*device_->physical());
    info.Device = static_cast<VkDevice>(*device_->handle());
    info.QueueFamily = device_->queue_family();
    info.Queue = static_cast<VkQueue>(*device_->queue());
    info.DescriptorPool = static_cast<VkDescriptorPool>(*pool_);
    info.MinImageCount = info.ImageCount = Screen::slots;
    ImGui_ImplVulkan_Init(&info, static_cast<VkRenderPass>(screen.passes().picture));
    const auto commands = device_->make_commands();
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    ImGui_ImplVulkan_CreateFontsTexture(static_cast<VkCommandBuffer>(*commands));
    commands.end();
    device_->run(commands);
    ImGui_ImplVulkan_DestroyFontUploadObjects();
}

Interface::~Interface()
{
    device_->wait_idle();
    ImGui_ImplVulkan_Shutdown();
    ImGui::DestroyContext(context_);
}

void Interface::take(const Event& event)
{
    ImGuiIO& io = ImGui::GetIO();
    switch (event.kind) {
        case Event::Kind::move:
            io.MousePos = {static_cast<float>(event.x), static_cast<float>(event.y)};
            break;
        case Event::Kind::button:
            if (event.code >= 0 && event.code < 5) io.MouseDown[event.code] = event.down;
            break;
        case Event::Kind::scroll: io.MouseWheel += static_cast<float>(event.y); break;
        case Event::Kind::text: io.AddInputCharacter(static_cast<unsigned>(event.code)); break;
        case Event::Kind::key:
            if (event.code < 0 || event.code >= 512) break;
            io.KeysDown[event.code] = event.down;
            io.KeyCtrl = io.KeysDown[GLFW_KEY_LEFT_CONTROL] || io.KeysDown[GLFW_KEY_RIGHT_CONTROL];
            io.KeyShift = io.KeysDown[GLFW_KEY_LEFT_SHIFT] || io.KeysDown[GLFW_KEY_RIGHT_SHIFT];
            break;
        default: break;
    }
}

bool Interface::wants_mouse() const { return ImGui::GetIO().WantCaptureMouse; }
bool Interface::wants_keys() const { return ImGui::GetIO().WantTextInput; }

void Interface::begin(vk::Extent2D size, double seconds)
{
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(size.width), static_cast<float>(size.height)};
    io.DeltaTime = static_cast<float>(std::max(seconds, 1e-5));
    ImGui_ImplVulkan_NewFrame();
    ImGui::NewFrame();
}

void Interface::end(const vk::raii::CommandBuffer* commands)
{
    ImGui::Render();
    if (commands)
        ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), static_cast<VkCommandBuffer>(**commands));
}

}  // namespace pliant::tool
