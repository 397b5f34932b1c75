import live_view

live_view.link.steering.ask("extract")
