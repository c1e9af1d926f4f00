// The viewer: a session, a screen, a camera, and the handling of events.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "render/picture_recorder.hpp"
#include "render/scene_drawing.hpp"
#include "viewer/interface.hpp"
#include "viewer/panel.hpp"
#include "viewer/screen.hpp"
#include "viewer/session.hpp"

namespace pliant::tool {

class Viewer {
public:
    /// Simulates on the screen's device if the backend is vulkan.
    Viewer(std::unique_ptr<Screen> screen, const SimulationOptions& simulation);
    ~Viewer();

    /// Throws Error as Session::open does.
    void open(const std::string& scene_or_mesh, const std::vector<std::string>& overrides = {});

    void handle(const Event& event);
    /// Handles the screen's events, then makes a frame that lasts `seconds`. `patience`: see
    /// Session::advance.
    void frame(double seconds, double patience);

    bool is_done() const { return done_; }
    Session& session() { return session_; }
    const View& view() const { return view_; }
    View& view() { return view_; }
    const OrbitCamera& camera() const { return camera_; }
    const Screen& screen() const { return *screen_; }
    /// Also writes the pictures of the following frames; see PictureRecorder.
    void record(const std::string& file);

private:
    void press_key(int key);
    void press_button(int button, bool down);
    void move_mouse(double x, double y);
    void grab();
    template <class Use>
    void with_node_at_mouse(Use&& use);
    Vec3d on_hand_plane() const;
    void try_open(const std::string& scene_or_mesh);
    void frame_everything();
    void toggle_recording();
    void update_drawing();
    void show(const Stepper::Seen& seen);
    void draw(double seconds);
    void take_picture();

    std::unique_ptr<Screen> screen_;
    std::shared_ptr<const vulkan::PictureKit> kit_;
    Interface interface_;
    Session session_;
    View view_;
    Panel panel_;
    OrbitCamera camera_;
    std::unique_ptr<vulkan::SceneDrawing> drawing_;
    std::vector<ClothFrame> frames_;
    std::uint64_t drawn_scene_ = 0, drawn_simulation_ = 0;  ///< for which `drawing_` was made
    bool springs_known_ = false;

    double mouse_x_ = 0, mouse_y_ = 0;
    bool held_buttons_[3] = {};
    bool shift_ = false;
    Vec3d hand_point_, hand_normal_;  ///< the plane of the hand's motion: through the node, facing the eye
    double clock_ = 0, last_click_ = -1;
    double click_x_ = 0, click_y_ = 0;

    std::vector<Event> events_;
    std::vector<std::string> screenshots_;  ///< to write from the next picture
    std::unique_ptr<PictureRecorder> recorder_;
    std::uint64_t recorded_ = 0;
    Image image_;
    unsigned files_ = 0;
    bool done_ = false;
};

}  // namespace pliant::tool
