//! x
use linecontact::*;
use linecontact::profile::*;
fn show(name: &str, r: Result<Solution<'_, f64>, ContactError<f64>>, t: std::time::Instant) {
    match r { Ok(s) => println!("{name}: {:?} F {} {} {:?} err {:?} report {:?} certify {:?}", s.intervals(), s.load(), s.cost(), t.elapsed(), s.limits_error(), s.report().attempts(), s.certify().map(|c| c.is_proved())), Err(e) => println!("{name}: {e} {:?}", t.elapsed()) }
}
fn main() {
    let l = |e: f64, nu: f64, thickness: f64, base| Layer { material: Material::elastic(e, nu), thickness, base };
    let half = |e: f64, nu: f64| Base::HalfPlane(Material::elastic(e, nu));
    let rigid = Material::Rigid;
    let now = std::time::Instant::now;
    // two contacts
    let two = Curve::new([-2.0, 2.0], |x: f64| CurvePoint { x, y: 0.5 * (x * x - 1.0).powi(2) + 0.03 * x, dx: 1.0, dy: 2.0 * x * (x * x - 1.0) + 0.03 });
    let t = now();
    let c = Contact::new(&Flat, &two).unwrap().materials(l(1.0, 0.3, 0.5, Base::Bonded), l(2.0, 0.4, 0.3, Base::Frictionless), PlaneState::Strain);
    let s = c.solve(Control::Load(0.2));
    if let Ok(s) = &s {
        for (on, g) in s.intervals().iter().zip([[-1.196828919442471, -0.7470943773397546], [0.802035958927394, 1.14053487234748]]) { println!("  {:.1e} {:.1e}", on.left - g[0], on.right - g[1]); }
        println!("  P(-1) {:.1e}", s.pressure().unwrap().at(-1.0).unwrap() / 0.38205042990074 - 1.0);
    }
    show("two", s, t);
    // wedge
    let left = Curve::new([-3.0, 0.0], |x: f64| CurvePoint { x, y: -0.3 * x, dx: 1.0, dy: -0.3 });
    let right = Curve::new([0.0, 3.0], |x: f64| CurvePoint { x, y: 0.3 * x, dx: 1.0, dy: 0.3 });
    let wedge = Piecewise::new(vec![Box::new(left) as Box<dyn ParametricProfile<f64>>, Box::new(right)]).unwrap();
    let t = now();
    let c = Contact::new(&Flat, &wedge).unwrap().materials(l(1.0, 0.3, 1.0, Base::Bonded), rigid, PlaneState::Strain);
    let s = c.solve(Control::Load(0.4));
    if let Ok(s) = &s { println!("  wedge {:.1e}", s.a() / 0.837686811249576 - 1.0); }
    show("wedge", s, t);
    // rough
    let rough = Curve::new([-5.0, 5.0], |x: f64| { let mut y = [x * x / 40.0, x / 20.0]; for (j, (q, ph)) in [(7.0, 0.3), (13.0, 1.1), (23.0, 2.0), (31.0, 4.0)].into_iter().enumerate() { let a = 0.02 / (j as f64 + 1.0).powi(2); y[0] += a * (q * x + ph as f64).cos(); y[1] -= a * q * (q * x + ph as f64).sin(); } CurvePoint { x, y: y[0], dx: 1.0, dy: y[1] } });
    for (e2, load, n, hull) in [(0.5, 0.1, 6, [-2.2597109514950158, 2.2031782901075987]), (0.2, 0.06, 8, [-2.277543016167543, 2.2122688808134523]), (5.0, 0.15, 4, [-1.4411686796371581, 1.4263537795910777])] {
        let t = now();
        let c = Contact::new(&Flat, &rough).unwrap().materials(l(1.0, 0.3, 1.0, half(e2, 0.3)), rigid, PlaneState::Strain);
        let s = c.solve(Control::Load(load));
        if let Ok(s) = &s { println!("  rough {} {n} {:.1e} {:.1e}", s.intervals().len(), s.hull().left - hull[0], s.hull().right - hull[1]); }
        show("rough", s, t);
    }
    // thin
    let par = Curve::new([-60.0, 60.0], |x: f64| CurvePoint { x, y: 0.5 * x * x, dx: 1.0, dy: x });
    for (name, base, c, la, l3) in [("slip 12", Base::Frictionless, 0.5, 0.1771315758, -0.0167511976), ("bonded 12", Base::Bonded, 0.4081632653, 0.1220706479, -0.0530083740)] {
        let k: f64 = 1.0 / 0.91 / 2.0 / c; let a: f64 = 12.0 + la; let f = 2.0 * k / 3.0 * (a * a * a - 3.0 * l3);
        let t = now();
        let c = Contact::new(&Flat, &par).unwrap().materials(l(1.0, 0.3, 1.0, base), rigid, PlaneState::Strain);
        let s = c.solve(Control::Load(f));
        if let Ok(s) = &s { println!("  thin {:.1e}", s.a() / 12.0 - 1.0); }
        show(name, s, t);
    }
    // controls
    let par = Curve::new([-6.0, 6.0], |x: f64| CurvePoint { x, y: 0.5 * x * x, dx: 1.0, dy: x });
    let c = Contact::new(&Flat, &par).unwrap().materials(l(1.0, 0.3, 1.0, Base::Bonded), rigid, PlaneState::Strain);
    let t = now();
    let s = c.solve(Control::HalfWidth(1.0));
    if let Ok(s) = &s { println!("  F {:.1e}", s.load() / 1.342633900238562303142 - 1.0); }
    show("half-width", s, t);
    let t = now();
    let s = c.solve(Control::PeakPressure(0.8844883640150628353102));
    if let Ok(s) = &s { println!("  F {:.1e}", s.load() / 1.342633900238562303142 - 1.0); }
    show("peak", s, t);
    let t = now();
    let s = c.solve(Control::Moment { load: 1.342633900238562303142, moment: 0.3, about: 0.0 });
    if let Ok(s) = &s { println!("  moment {:.1e} tilt {}", s.moment().unwrap_or(f64::NAN), s.tilt()); }
    show("moment", s, t);
    // layer = base
    let c = Contact::new(&Flat, &par).unwrap().materials(l(1.0, 0.3, 1.0, half(1.0, 0.3)), rigid, PlaneState::Strain);
    let h = Contact::new(&Flat, &par).unwrap().materials(Material::elastic(1.0, 0.3), rigid, PlaneState::Strain);
    let t = now();
    let s = c.solve(Control::Load(0.5));
    if let (Ok(s), Ok(h)) = (&s, h.solve(Control::Load(0.5))) { println!("  same {:.1e}", s.a() / h.a() - 1.0); }
    show("same", s, t);
    // coating 3 um on a roller
    let arc = Ellipse::circle(10.0, [-1.5, 1.5]).unwrap();
    for ratio in [400.0 / 210.0, 10.0, 100.0, 0.1, 0.01] {
    let c = Contact::new(&Flat, &arc).unwrap().materials(Material::elastic(210e3, 0.3), l(210e3 * ratio, 0.3, 0.003, half(210e3, 0.3)), PlaneState::Strain);
    for load in [10.0, 100.0, 1000.0] { let t = now(); show(&format!("coating {ratio} {load}"), c.solve(Control::Load(load)), t); }
    }
    let mut solver = Solver::new();
    let c = Contact::new(&Flat, &par).unwrap().materials(l(1.0, 0.3, 1.0, Base::Bonded), rigid, PlaneState::Strain);
    for load in [1.0, 1.01, 1.02, 1.5, 0.5] { let t = now(); show(&format!("warm {load}"), solver.solve(&c, Control::Load(load)), t); }
}
