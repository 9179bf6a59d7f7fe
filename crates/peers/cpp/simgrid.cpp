// Runs an exchange of messages on a mesh in SimGrid.
//
// Arguments: options of SimGrid, such as --cfg=network/model:LV08.
// Input, separated by blanks: columns and rows of hosts, rounds, bytes of a message, bandwidth in bytes per
// second, latency of a message and of a hop in seconds; then for each host its four neighbours.
// Output: version; then CPU seconds of the run, messages, virtual seconds.

#if !__has_include(<simgrid/s4u.hpp>)
#error "SimGrid is not installed"
#endif
#include <simgrid/s4u.hpp>
#include <simgrid/version.h>

#include <array>
#include <ctime>
#include <iostream>
#include <string>
#include <vector>

namespace sg4 = simgrid::s4u;

namespace {

int columns, rows, rounds;
double bytes, bandwidth, latency, hop;

// A mesh with one port for each host and two links between neighbours, routed along the row first.
struct Mesh {
    sg4::NetZone *zone = sg4::create_full_zone("mesh");
    std::vector<sg4::Host *> hosts;
    std::vector<sg4::Link *> ports;
    // Links from a host to the west, east, south and north.
    std::vector<std::array<sg4::Link *, 4>> links;

    Mesh() {
        const auto link = [&](const std::string &name, double delay) {
            return zone->create_link(name, bandwidth)->set_latency(delay)->seal();
        };
        for (int i = 0; i < columns * rows; ++i) {
            const auto name = std::to_string(i);
            hosts.push_back(zone->create_host("host " + name, 1e9)->seal());
            ports.push_back(link("port " + name, latency));
            links.emplace_back();
            for (int side = 0; side < 4; ++side)
                links.back()[side] = link("link " + name + " " + std::to_string(side), hop);
        }
        for (int from = 0; from < columns * rows; ++from)
            for (int to = 0; to < columns * rows; ++to)
                if (from != to)
                    zone->add_route(hosts[from]->get_netpoint(), hosts[to]->get_netpoint(), nullptr,
                                    nullptr, route(from, to), false);
        zone->seal();
    }

    std::vector<sg4::LinkInRoute> route(int from, int to) const {
        std::vector<sg4::LinkInRoute> way{sg4::LinkInRoute(ports[from])};
        for (int here = from; here != to;) {
            const int east = to % columns - here % columns, north = to / columns - here / columns;
            const int side = east < 0 ? 0 : east > 0 ? 1 : north < 0 ? 2 : 3;
            way.emplace_back(links[here][side]);
            here += std::array<int, 4>{-1, 1, -columns, columns}[side];
        }
        return way;
    }
};

struct Node {
    sg4::Mailbox *own;
    std::array<sg4::Mailbox *, 4> neighbours;
    size_t *taken;

    void operator()() const {
        static int load;
        for (int round = 0; round < rounds; ++round) {
            std::array<int *, 4> received{};
            std::vector<sg4::CommPtr> pending;
            for (int i = 0; i < 4; ++i) pending.push_back(own->get_async<int>(&received[i]));
            for (auto *to : neighbours) pending.push_back(to->put_async(&load, bytes));
            sg4::Comm::wait_all(pending);
            for (const auto *message : received) *taken += message == &load;
        }
    }
};

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
}

}  // namespace

int main(int argc, char **argv) {
    sg4::Engine engine(&argc, argv);
    std::cin >> columns >> rows >> rounds >> bytes >> bandwidth >> latency >> hop;
    const Mesh mesh;
    std::vector<sg4::Mailbox *> mailboxes;
    for (int i = 0; i < columns * rows; ++i)
        mailboxes.push_back(sg4::Mailbox::by_name(std::to_string(i)));
    size_t taken = 0;
    for (int i = 0; i < columns * rows; ++i) {
        Node node{mailboxes[i], {}, &taken};
        for (auto &neighbour : node.neighbours) {
            int number = 0;
            std::cin >> number;
            neighbour = mailboxes.at(number);
        }
        sg4::Actor::create("node " + std::to_string(i), mesh.hosts[i], node);
    }
    int version[3];
    sg_version_get(&version[0], &version[1], &version[2]);
    std::cout << version[0] << '.' << version[1] << '.' << version[2] << std::endl;
    const double start = cpu_seconds();
    engine.run();
    std::cout << cpu_seconds() - start << ' ' << taken << ' ' << sg4::Engine::get_clock() << std::endl;
}
