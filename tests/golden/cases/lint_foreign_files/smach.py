#!/usr/bin/env python
import rospy
import smach

class Foo(smach.State):
    def __init__(self):
        smach.State.__init__(self, outcomes=['ok'])
