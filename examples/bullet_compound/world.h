// A Bullet world with gravity along -y and a floor at y = 0.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

class World {
 public:
  World() {
    dynamics_.setGravity({0, -9.81f, 0});
    btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, &floor_shape_);
    info.m_friction = 0.9f;
    info.m_rollingFriction = 0.5f;
    info.m_spinningFriction = 0.5f;
    floor_ = std::make_unique<btRigidBody>(info);
    dynamics_.addRigidBody(floor_.get());
  }
  ~World() {
    for (const auto& body : bodies_) dynamics_.removeRigidBody(body.get());
    dynamics_.removeRigidBody(floor_.get());
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  btRigidBody& add(std::unique_ptr<btRigidBody> body) {
    dynamics_.addRigidBody(body.get());
    bodies_.push_back(std::move(body));
    return *bodies_.back();
  }

  // One step of fixed length, in seconds.
  void step(btScalar seconds) { dynamics_.stepSimulation(seconds, 0); }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld dynamics_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btStaticPlaneShape floor_shape_{{0, 1, 0}, 0};
  std::unique_ptr<btRigidBody> floor_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};
