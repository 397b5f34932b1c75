import live_view

live_view.link.pause(False)
