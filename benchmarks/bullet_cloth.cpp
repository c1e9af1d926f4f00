#include "bullet_cloth.hpp"

#ifdef PLIANT_HAS_BULLET
#include <vector>

#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>
#endif

namespace pliant::bullet {

#ifdef PLIANT_HAS_BULLET
namespace {

btVector3 vector_of(serial::Vector a) { return {a.x, a.y, a.z}; }

class World final : public SoftBody {
public:
    explicit World(const serial::Cloth& cloth)
        : dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &solver_, &configuration_)
    {
        world_.setGravity(vector_of(cloth.gravity));
        btSoftBodyWorldInfo& info = world_.getWorldInfo();
        info.m_gravity = vector_of(cloth.gravity);
        info.m_dispatcher = &dispatcher_;
        info.m_broadphase = &broadphase_;
        info.m_sparsesdf.Initialize();

        std::vector<btVector3> positions;
        std::vector<btScalar> masses;
        for (const serial::Node& node : cloth.nodes) {
            positions.push_back(vector_of(node.position));
            masses.push_back(node.inverse_mass > 0 ? 1 / node.inverse_mass : 0);
        }
        body_ = std::make_unique<btSoftBody>(&info, static_cast<int>(positions.size()), positions.data(),
                                             masses.data());
        for (const serial::Spring& spring : cloth.springs)
            body_->appendLink(static_cast<int>(spring.i), static_cast<int>(spring.j), body_->m_materials[0]);
        body_->m_cfg.piterations = 1;
        world_.addSoftBody(body_.get());
    }
    ~World() override { world_.removeSoftBody(body_.get()); }

    void step(float dt) override { world_.stepSimulation(dt, 0); }
    serial::Vector position(std::size_t node) const override
    {
        const btVector3& x = body_->m_nodes[static_cast<int>(node)].m_x;
        return {x.x(), x.y(), x.z()};
    }

private:
    btSoftBodyRigidBodyCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btSoftRigidDynamicsWorld world_;
    std::unique_ptr<btSoftBody> body_;
};

}  // namespace

std::unique_ptr<SoftBody> soft_body_of(const serial::Cloth& cloth) { return std::make_unique<World>(cloth); }
#else
std::unique_ptr<SoftBody> soft_body_of(const serial::Cloth&) { return nullptr; }
#endif

}  // namespace pliant::bullet
