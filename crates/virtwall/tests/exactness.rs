//! What virtual interfaces must not change: where a ray ends, and what becomes of each pixel.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use common::{face, grey, problem, scene, sides};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use radiosity::glam::DVec3;
use radiosity::{
    Emitter, End, Face, Grid, Hemisphere, HemisphereKind, LocalEnvironment, Mask, PatchSize, Ray,
    Scene, Side, Space, Work, cast, shoot, shoot_plainly,
};
use virtwall::{Problem, ProblemOptions};

const SIZE: f64 = 1.1;

/// A coordinate: anywhere, or exactly on a plane of the grid, by number.
#[derive(Clone, Debug)]
enum Coordinate {
    Anywhere(f64),
    OnPlane(u32),
}

#[derive(Clone, Debug)]
enum Shape {
    /// An axis-aligned rectangle: axis, coordinates, whether it faces up the axis.
    Rectangle(usize, [Coordinate; 5], bool),
    Triangle([[Coordinate; 3]; 3]),
}

fn coordinate() -> impl Strategy<Value = Coordinate> {
    prop_oneof![
        (0.02..0.98f64).prop_map(Coordinate::Anywhere),
        (1u32..12).prop_map(Coordinate::OnPlane),
    ]
}

fn shape() -> impl Strategy<Value = Shape> {
    let coordinates = || [coordinate(), coordinate(), coordinate(), coordinate(), coordinate()];
    let corner = || [coordinate(), coordinate(), coordinate()];
    prop_oneof![
        3 => (0usize..3, coordinates(), any::<bool>()).prop_map(|(a, c, up)| Shape::Rectangle(a, c, up)),
        1 => [corner(), corner(), corner()].prop_map(Shape::Triangle),
    ]
}

/// The shapes in a closed box, their coordinates on the planes of the grid that the box will have.
fn build(shapes: &[Shape], cells: [u32; 3]) -> Scene {
    let shell = sides([0.0; 3], [8.0, 6.0, 4.0], [0; 6], true);
    let materials = vec![grey(0.5, 0.0), grey(0.2, 10.0)];
    let empty = scene(&shell, materials.clone());
    let planes = Grid::planes(&empty, cells);
    let at = |axis: usize, coordinate: &Coordinate| match *coordinate {
        Coordinate::Anywhere(fraction) => fraction * [8.0, 6.0, 4.0][axis],
        Coordinate::OnPlane(i) => {
            let inner = 1 + (i as usize) % (planes[axis].len() - 2).max(1);
            let plane = planes[axis][inner.min(planes[axis].len() - 1)] + empty.origin[axis];
            if plane < [8.0, 6.0, 4.0][axis] { plane } else { 0.5 }
        }
    };
    let mut faces: Vec<Face> = shell;
    for shape in shapes {
        faces.push(match shape {
            Shape::Rectangle(axis, c, up) => {
                let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                let (u0, u1) = (at(u, &c[1]), at(u, &c[2]));
                let (v0, v1) = (at(v, &c[3]), at(v, &c[4]));
                let corner = |p: f64, q: f64| {
                    let mut point = [0.0; 3];
                    (point[*axis], point[u], point[v]) = (at(*axis, &c[0]), p, q);
                    point
                };
                let mut quad = [corner(u0, v0), corner(u1, v0), corner(u1, v1), corner(u0, v1)];
                if *up != ((u1 > u0) == (v1 > v0)) {
                    quad.reverse();
                }
                face(&quad, 1)
            }
            Shape::Triangle(corners) => {
                let points = corners.each_ref().map(|c| [at(0, &c[0]), at(1, &c[1]), at(2, &c[2])]);
                face(&points, 1)
            }
        });
    }
    scene(&faces, materials)
}

fn hemisphere() -> impl Strategy<Value = Hemisphere> {
    use HemisphereKind::{Concentric, Fibonacci, Hemicube, Polar};
    (prop_oneof![Just(Fibonacci), Just(Hemicube), Just(Polar), Just(Concentric)], any::<bool>())
        .prop_map(|(kind, rotated)| Hemisphere::new(kind, 169, rotated).unwrap())
}

fn case() -> impl Strategy<Value = (Scene, ProblemOptions)> {
    let cells = [1u32..8, 1u32..8, 1u32..8];
    let shapes = proptest::collection::vec(shape(), 0..12);
    let fractions = [0.0..1.0f64, 0.0..1.0f64, 0.0..1.0f64];
    (shapes, cells, fractions, hemisphere()).prop_map(|(shapes, cells, fractions, hemisphere)| {
        let cut = std::array::from_fn(|axis| 1 + (fractions[axis] * f64::from(cells[axis])) as u32);
        let patch_size = PatchSize { reflector: SIZE, emitter: SIZE };
        (build(&shapes, cells), ProblemOptions { patch_size, cells, cut, hemisphere })
    })
}

/// Every patch of a problem as a source.
fn sources(problem: &Problem) -> Vec<Emitter> {
    let source = |environment: u32, patch: u32, p: &radiosity::Patch| Emitter {
        environment,
        patch,
        polygon: p.polygon,
        centre: p.centre,
        normal: problem.space.scene.polygons[p.polygon as usize].plane.normal,
        power: DVec3::ONE,
        radiosity: DVec3::ONE,
    };
    let environments = (0u32..).zip(&problem.environments);
    environments
        .flat_map(|(e, environment)| {
            (0u32..).zip(&environment.patches).map(move |(i, p)| source(e, i, p))
        })
        .collect()
}

/// Follow a ray from environment to environment.
fn follow(problem: &Problem, source: &Emitter, ray: &Ray) -> End {
    let mut environment = source.environment;
    for _ in 0..10_000 {
        let here = &problem.environments[environment as usize];
        match cast(&problem.space, here, ray, source.polygon, &mut Work::default()) {
            End::Leaves(side) if here.has_neighbour(side) => {
                environment = problem.decomposition.neighbour(environment, side);
            }
            end => return end,
        }
    }
    panic!("a ray that never ends");
}

/// Shoot a source in its environment, and what is left of its mask in every environment that it is
/// handed on to, in bundles and plainly.
fn same_shots(problem: &Problem, source: &Emitter) {
    let mut waiting = vec![(source.environment, Mask::all(problem.hemisphere.pixels()))];
    while let Some((number, mask)) = waiting.pop() {
        let environment = &problem.environments[number as usize];
        let [fast, plain] = [shoot, shoot_plainly]
            .map(|shoot| shoot(&problem.space, environment, &problem.hemisphere, source, &mask));
        assert_eq!(fast, plain);
        for (side, outgoing) in Side::ALL.into_iter().zip(plain.outgoing) {
            let neighbour = |mask| (problem.decomposition.neighbour(number, side), mask);
            waiting.extend(outgoing.map(|outgoing| outgoing.mask).map(neighbour));
        }
    }
}

fn rays<'a>(hemisphere: &'a Hemisphere, source: &Emitter) -> impl Iterator<Item = Ray> + 'a {
    let [t, b, n] = hemisphere.frame(source.centre, source.normal);
    let centre = source.centre;
    hemisphere.directions.iter().map(move |d| Ray::new(centre, t * d.x + b * d.y + n * d.z))
}

proptest! {
    // The same cases every time; others with another seed.
    #![proptest_config(ProptestConfig {
        cases: 300,
        rng_seed: RngSeed::Fixed(1996),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// The surface point that a ray hits is the same to the bit in one environment and in many, and
    /// nothing leaks out of a closed box.
    #[test]
    fn hits_do_not_depend_on_the_decomposition((scene, options) in case()) {
        let size = options.patch_size;
        let problem = Problem::new(scene, options).unwrap();
        let whole = problem.space.grid.whole();
        let single = LocalEnvironment::new(&problem.space, whole, size);
        for source in sources(&problem) {
            for ray in rays(&problem.hemisphere, &source) {
                let one = cast(&problem.space, &single, &ray, source.polygon, &mut Work::default());
                prop_assert_eq!(one, follow(&problem, &source, &ray));
                prop_assert!(matches!(one, End::Hit { .. }), "{:?} leaks from {:?}", ray, source);
            }
        }
    }

    /// The grid walk finds what testing every polygon finds.
    #[test]
    fn the_grid_finds_the_nearest_polygon((scene, options) in case()) {
        let problem = Problem::new(scene, options).unwrap();
        let space = &problem.space;
        let tolerance = space.scene.tolerance();
        for source in sources(&problem).iter().step_by(7) {
            for ray in rays(&problem.hemisphere, source) {
                let others = (0..space.scene.polygons.len() as u32).filter(|&p| p != source.polygon);
                let nearest = others.filter_map(|p| space.facets.hit(p, &ray, f64::INFINITY));
                let nearest = nearest.fold(f64::INFINITY, f64::min);
                let End::Hit { distance, .. } = follow(&problem, source, &ray) else {
                    panic!("{ray:?} leaks");
                };
                prop_assert!((distance - nearest).abs() <= tolerance, "{distance} {nearest}");
            }
        }
    }

    /// §3.3: in every environment hits, outgoing masks and escapes part the incoming mask among
    /// them, and no pixel goes to two neighbours.
    #[test]
    fn pixels_are_parted((scene, options) in case(), salt in any::<u64>()) {
        let problem = Problem::new(scene, options).unwrap();
        let pixels = problem.hemisphere.pixels();
        for source in sources(&problem).iter().step_by(5) {
            let mut incoming = Mask::none(pixels);
            (0..pixels).filter(|i| salt.rotate_left(i % 64) & 1 == 1).for_each(|i| incoming.set(i));
            let environment = &problem.environments[source.environment as usize];
            let shot =
                shoot(&problem.space, environment, &problem.hemisphere, source, &incoming);
            let mut outgoing = Mask::none(pixels);
            let mut count = 0;
            for out in shot.outgoing.iter().flatten() {
                count += out.mask.count();
                outgoing.merge(&out.mask);
            }
            prop_assert_eq!(count, outgoing.count(), "a pixel goes to two neighbours");
            prop_assert!(outgoing.ones().all(|pixel| incoming.get(pixel)));
            let weight: f64 =
                incoming.ones().map(|i| problem.hemisphere.weights[i as usize]).sum();
            let hit: f64 = shot.hits.iter().map(|&(_, form_factor)| form_factor).sum();
            let out: f64 = shot.outgoing.iter().flatten().map(|o| o.form_factor).sum();
            prop_assert!((hit + shot.backs + shot.escaped + out - weight).abs() < 1e-12);
        }
    }

    /// The fast path is its plain twin, to the bit: hits, masks and counted work, for a local source
    /// and in every environment that it is handed on to.
    #[test]
    fn bundles_shoot_as_single_rays_do((scene, options) in case()) {
        let problem = Problem::new(scene, options).unwrap();
        for source in sources(&problem).iter().step_by(3) {
            same_shots(&problem, source);
        }
    }

    /// Splitting and meshing lose no area.
    #[test]
    fn patches_cover_the_scene((scene, options) in case()) {
        let area = scene.area();
        let problem = Problem::new(scene, options).unwrap();
        let patches = problem.environments.iter().flat_map(|e| &e.patches);
        let covered: f64 = patches.map(|patch| patch.area).sum();
        prop_assert!((covered - area).abs() <= 1e-7 * area, "{covered} of {area}");
    }
}

/// A light exactly between two environments, over the edge where they meet, with rays in the plane
/// between them: no ray is claimed by two neighbours, none is lost.
#[test]
fn rays_in_the_plane_between_two_environments_have_one_owner() {
    let cells = [4, 4, 4];
    let shell = sides([-2.0; 3], [2.0; 3], [0; 6], true);
    let planes = Grid::planes(&scene(&shell, vec![grey(0.5, 0.0)]), cells);
    // A lamp of odd patch count along x whose middle patch is centred on the plane of the cut.
    let x = planes[0][2];
    let mut faces = shell;
    let lamp =
        [[x - 0.5, -0.5, 1.9], [x - 0.5, 0.5, 1.9], [x + 0.5, 0.5, 1.9], [x + 0.5, -0.5, 1.9]];
    faces.push(face(&lamp, 1));
    let scene = scene(&faces, vec![grey(0.5, 0.0), grey(0.0, 1.0)]);
    let hemisphere = Hemisphere::new(HemisphereKind::Concentric, 181 * 181, false).unwrap();
    let patch_size = PatchSize { reflector: 1.0, emitter: 1.0 };
    let options = ProblemOptions { patch_size, cells, cut: [2, 1, 1], hemisphere };
    let problem = Problem::new(scene, options).unwrap();
    let centre = DVec3::new(x, 0.0, 1.9);
    let lamp = problem.space.scene.polygons.len() as u32 - 1;
    let source = Emitter {
        environment: 0,
        patch: 0,
        polygon: lamp,
        centre,
        normal: -DVec3::Z,
        power: DVec3::ONE,
        radiosity: DVec3::ONE,
    };
    let mut in_plane = 0;
    for ray in rays(&problem.hemisphere, &source) {
        in_plane += u32::from(ray.direction.x == 0.0);
        assert!(matches!(follow(&problem, &source, &ray), End::Hit { .. }), "{ray:?}");
    }
    assert!(in_plane >= 181, "{in_plane} rays in the plane");
}

/// Environments without a polygon, and as many environments as cells, work like any others.
#[test]
fn empty_and_one_cell_environments() {
    let shell = || scene(&sides([0.0; 3], [4.0; 3], [0; 6], true), vec![grey(0.5, 1.0)]);
    let problem = problem(shell(), [5, 5, 5], [5, 5, 5], 256, 1.0);
    assert_eq!(problem.environments.len(), 125);
    assert!(problem.environments.iter().any(|e| e.patches.is_empty()));
    let space = Space::new(shell(), [5, 5, 5]);
    assert_eq!(space.grid.cells(), [5, 5, 5]);
    for source in sources(&problem) {
        for ray in rays(&problem.hemisphere, &source) {
            assert!(matches!(follow(&problem, &source, &ray), End::Hit { .. }));
        }
    }
}

/// Where a bundle meets so many small polygons that its rays go one by one, nothing changes either.
#[test]
fn bundles_shoot_as_single_rays_do_at_many_small_polygons() {
    let height = |i: u32, j: u32| 0.3 * (f64::from(i * 7 % 5) + f64::from(j * 3 % 4));
    let corner = |i: u32, j: u32| [f64::from(i) * 0.2, f64::from(j) * 0.2, height(i, j)];
    let mut faces = Vec::new();
    for (i, j) in (0..30).flat_map(|i| (0..30).map(move |j| (i, j))) {
        faces.push(face(&[corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)], 0));
        faces.push(face(&[corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)], 0));
    }
    let lamp = [[2.0, 2.0, 3.0], [2.0, 4.0, 3.0], [4.0, 4.0, 3.0], [4.0, 2.0, 3.0]];
    faces.push(face(&lamp, 1));
    let scene = scene(&faces, vec![grey(0.5, 0.0), grey(0.0, 1.0)]);
    let problem = problem(scene, [12, 12, 4], [2, 1, 1], 256, 1.0);
    for source in sources(&problem).iter().step_by(40) {
        same_shots(&problem, source);
    }
}
