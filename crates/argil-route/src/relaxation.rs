//! Demands moved within their slack towards the tours that visit them.

use argil_curve::{DVec2, on_grid};

use crate::RouteError;
use crate::discs::Discs;
use crate::region_plan::{RegionPlan, RegionView};
use crate::sketch::{Sketch, Stop};

impl RegionView<'_> {
    /// The demands moved within their slack towards the straight ways between the stops of a sketch.
    pub(crate) fn relaxed_along(&self, sketch: &Sketch, demands: &[DVec2]) -> Vec<DVec2> {
        let count = demands.len();
        let mut points = demands.to_vec();
        points.extend(sketch.places.iter().map(|&(wall, arc)| self.wall(wall).point_at(arc)));
        let point = |stop: &Stop| match *stop {
            Stop::Demand(demand) => demand,
            Stop::Place(place) => count + place,
        };
        let mut neighbours = vec![Vec::new(); count];
        for tour in &sketch.tours {
            for (stop, next) in tour.iter().zip(tour.iter().cycle().skip(1)) {
                for (here, there) in [(point(stop), point(next)), (point(next), point(stop))] {
                    if let Some(met) = neighbours.get_mut(here) {
                        met.push(there);
                    }
                }
            }
        }
        self.moved(points, &neighbours)
    }

    /// The demands moved within their slack towards the tours of a plan.
    pub(crate) fn relaxed(&self, plan: &RegionPlan) -> Result<Vec<DVec2>, RouteError> {
        let count = plan.demands.len();
        // Points: the demands, then the other vertices of the graph as they are met.
        let mut points = plan.demands.clone();
        points.extend(plan.graph.positions());
        let mut demand_at = vec![usize::MAX; plan.graph.vertex_count()];
        for demand in (0..count).rev() {
            demand_at[plan.graph.terminal(demand) as usize] = demand;
        }
        let place = |v: u32| match demand_at[v as usize] {
            usize::MAX => count + v as usize,
            demand => demand,
        };
        let mut neighbours = vec![Vec::new(); count];
        for tour in &plan.tours {
            plan.walk(tour, |path| {
                for pair in path.windows(2) {
                    for (here, there) in [(pair[0], pair[1]), (pair[1], pair[0])] {
                        if let Some(met) = neighbours.get_mut(place(here)) {
                            met.push(place(there));
                        }
                    }
                }
            })?;
        }
        Ok(self.moved(points, &neighbours))
    }

    /// The demands, which are the first of the points, moved within their slack towards their neighbours.
    fn moved(&self, mut points: Vec<DVec2>, neighbours: &[Vec<usize>]) -> Vec<DVec2> {
        let s = self.settings;
        let discs = Discs {
            anchors: &self.anchors,
            radius: s.slack,
            walls: &self.index,
            wall_keep: s.wall_keep * s.width,
        };
        discs.relax(&mut points, neighbours);
        points.truncate(neighbours.len());
        points.into_iter().map(|p| on_grid(p, s.grid)).collect()
    }
}
