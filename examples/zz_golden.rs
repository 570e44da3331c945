use linecontact::{Base, Contact, Control, Curve, CurvePoint, Flat, Layer, Material, PlaneState};
fn main() {
    let l = |nu: f64, base| Layer { material: Material::elastic(1.0, nu), thickness: 1.0, base };
    let half = |e: f64, nu: f64| Base::HalfPlane(Material::elastic(e, nu));
    for (name, layer, f, p0) in [
        ("slip .3", l(0.3, Base::Frictionless), 1.227850119433401256398f64, 0.8005365572782310503394f64),
        ("bonded .3", l(0.3, Base::Bonded), 1.342633900238562303142, 0.8844883640150628353102),
        ("bonded .5", l(0.5, Base::Bonded), 1.993130220865807288014, 1.334884709865004453161),
        ("E2=5", l(0.3, half(5.0, 0.3)), 1.190256994927218168495, 0.77732960033319168596),
        ("E2=.2", l(0.3, half(0.2, 0.3)), 0.4548340803709273390107, 0.2731421590441292018558),
        ("E2=.01", l(0.2, half(0.01, 0.4)), 0.1148720794279580565553, 0.06162912508735175723665),
    ] {
        let body = Curve::new([-6.0, 6.0], |x: f64| CurvePoint { x, y: 0.5 * x * x, dx: 1.0, dy: x });
        let c = Contact::new(&Flat, &body).unwrap().materials(layer, Material::Rigid, PlaneState::Strain);
        let t = std::time::Instant::now();
        match c.solve(Control::Load(f)) {
            Ok(s) => {
                let t = t.elapsed();
                let p = s.pressure().unwrap().at(0.0).unwrap();
                println!("{name}: a {:.1e} p {:.1e} {} {t:?} err {:?} {:?}", s.a() - 1.0, p / p0 - 1.0, s.cost(), s.limits_error(), s.report());
                println!("   certify {:?}", s.certify().map(|c| c.is_proved()));
            }
            Err(e) => println!("{name}: {e}"),
        }
    }
}
