(define (domain simple)
 (:requirements :strips :typing)
 (:types robot room))
